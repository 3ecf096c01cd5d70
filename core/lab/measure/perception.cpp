#include "core/lab/measure/perception.h"

#include "core/base/angle.h"
#include "core/base/units.h"
#include "core/mesh/triangle_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tangent {
namespace {

Vec3 normal_of(const ContactMesh& mesh, std::uint32_t t) {
  const auto [a, b, c] = mesh.positions(t);
  return face_normal(a, b, c);
}

/// Calls `visit(triangle, edge)` once for every edge, from its lower numbered triangle.
template <class Visit>
void for_each_edge(const ContactMesh& mesh, Visit visit) {
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const EdgeLink other = mesh.across(t, k);
      if (other.triangle == kNone || other.triangle > t || (other.triangle == t && other.edge > k)) visit(t, k);
    }
  }
}

FeltEdge describe(const ContactMesh& mesh, std::uint32_t t, std::uint32_t k, double angle_deg) {
  const Vec3 a = mesh.position(t, k), b = mesh.position(t, (k + 1) % 3);
  return {t, k, angle_deg, glm::length(b - a), mesh.origin() + 0.5 * (a + b)};
}

void add_edge(const FeltEdge& edge, ConditionFeel& feel) {
  const double upper = feel.threshold.interval_deg ? feel.threshold.interval_deg->second : feel.threshold.mean_deg;
  const double lower = feel.threshold.interval_deg ? feel.threshold.interval_deg->first : feel.threshold.mean_deg;
  ++feel.curve_edges;
  feel.curve_length_m += edge.length_m;
  if (edge.angle_deg > upper)
    ++feel.surely_felt;
  else if (edge.angle_deg > lower)
    ++feel.doubtful;
  if (edge.angle_deg <= feel.threshold.mean_deg) return;
  ++feel.felt;
  feel.felt_length_m += edge.length_m;
  // Kept sorted; short.
  const auto worse = [](const FeltEdge& a, const FeltEdge& b) { return a.angle_deg > b.angle_deg; };
  if (feel.worst.size() == kWorstEdges && !worse(edge, feel.worst.back())) return;
  feel.worst.insert(std::upper_bound(feel.worst.begin(), feel.worst.end(), edge, worse), edge);
  if (feel.worst.size() > kWorstEdges) feel.worst.pop_back();
}

std::string share_text(double share) {
  char text[32];
  // Rounding must not turn 0.03 % into none or 99.97 % into all.
  if (share > 0.0 && share < 0.1)
    std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share);
  else
    std::snprintf(text, sizeof text, "%.0f %%", std::floor(100.0 * share));
  return text;
}

std::string edges_text(const ConditionFeel& feel) {
  char above[48];
  std::snprintf(above, sizeof above, " above %.1f deg", feel.threshold.mean_deg);
  const std::string share = feel.felt == 0                  ? "none are"
                            : feel.felt == feel.curve_edges ? "all edges are"
                                                            : share_text(feel.felt_share()) + " of edges are";
  return share + above;
}

}  // namespace

FacetAngles facet_angles(const ContactMesh& mesh) {
  FacetAngles out;
  constexpr std::array<EdgeSense, 3> kNowhere{EdgeSense::boundary, EdgeSense::boundary, EdgeSense::boundary};
  out.angle_deg.assign(mesh.triangle_count(), {0.0f, 0.0f, 0.0f});
  out.sense.assign(mesh.triangle_count(), kNowhere);
  for_each_edge(mesh, [&](std::uint32_t t, std::uint32_t k) {
    const EdgeLink other = mesh.across(t, k);
    if (other.triangle == kNone) return;
    const double angle = angle_between_deg(normal_of(mesh, t), normal_of(mesh, other.triangle));
    const EdgeSense sense = mesh.edge_kind(t, k) == EdgeKind::crease ? EdgeSense::crease
                            : angle < kFlatEdgeDeg                   ? EdgeSense::flat
                                                                     : EdgeSense::curve;
    out.angle_deg[t][k] = out.angle_deg[other.triangle][other.edge] = static_cast<float>(angle);
    out.sense[t][k] = out.sense[other.triangle][other.edge] = sense;
  });
  return out;
}

PerceptionAudit audit_perception(const ContactMesh& mesh, const FacetAngles& angles) {
  PerceptionAudit audit;
  for (std::size_t i = 0; i < audit.conditions.size(); ++i) audit.conditions[i].threshold = kPerceptionThresholds[i];
  std::vector<float> curve;
  for_each_edge(mesh, [&](std::uint32_t t, std::uint32_t k) {
    switch (angles.sense[t][k]) {
      case EdgeSense::flat:
        ++audit.flat_edges;
        return;
      case EdgeSense::crease:
        ++audit.crease_edges;
        return;
      case EdgeSense::boundary:
        ++audit.boundary_edges;
        return;
      case EdgeSense::curve:
        break;
    }
    ++audit.curve_edges;
    curve.push_back(angles.angle_deg[t][k]);
    const FeltEdge edge = describe(mesh, t, k, static_cast<double>(angles.angle_deg[t][k]));
    for (ConditionFeel& feel : audit.conditions) add_edge(edge, feel);
  });
  if (curve.empty()) return audit;
  const auto middle = curve.begin() + static_cast<std::ptrdiff_t>(curve.size() / 2);
  std::nth_element(curve.begin(), middle, curve.end());
  audit.median_curve_deg = static_cast<double>(*middle);
  audit.largest_curve_deg = static_cast<double>(*std::max_element(curve.begin(), curve.end()));
  return audit;
}

int threshold_index(std::string_view condition) {
  for (std::size_t i = 0; i < kPerceptionThresholds.size(); ++i)
    if (kPerceptionThresholds[i].condition == condition) return static_cast<int>(i);
  return -1;
}

std::string verdict(const PerceptionAudit& audit, int condition) {
  if (audit.curve_edges == 0)
    return "no edge lies between facets of a curve: there is nothing that shading would smooth";
  const ConditionFeel& chosen = audit.conditions[static_cast<std::size_t>(condition)];
  const bool pilot = !chosen.threshold.interval_deg;
  std::string text =
      "under " + std::string(chosen.threshold.condition) + (pilot ? " (pilot data) " : " ") + edges_text(chosen);
  if (chosen.felt == 0)
    text += chosen.doubtful == 0 ? ": it will feel smooth"
                                 : ", but some within the threshold's interval: it may feel smooth";
  else
    text += ": facets will be felt";
  if (chosen.threshold.condition == "P1") return text;
  return text + "; with force and tactile shading (P1, pilot data) " +
         edges_text(audit.conditions[static_cast<std::size_t>(threshold_index("P1"))]);
}

double largest_curve_angle_rad(const ContactMesh& mesh, std::uint32_t t) {
  double largest = 0.0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (mesh.edge_kind(t, k) != EdgeKind::smooth) continue;
    const double angle = angle_between_deg(normal_of(mesh, t), normal_of(mesh, mesh.across(t, k).triangle));
    if (angle >= kFlatEdgeDeg) largest = std::max(largest, angle * kDegree);
  }
  return largest;
}

std::vector<float> felt_ratio(const FacetAngles& angles, const PerceptionThreshold& threshold) {
  std::vector<float> ratio(angles.angle_deg.size(), 0.0f);
  const auto mean = static_cast<float>(threshold.mean_deg);
  for (std::size_t t = 0; t < ratio.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (angles.sense[t][k] == EdgeSense::curve) ratio[t] = std::max(ratio[t], angles.angle_deg[t][k] / mean);
  return ratio;
}

}  // namespace tangent
