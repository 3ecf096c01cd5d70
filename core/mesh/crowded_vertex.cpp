#include "core/mesh/crowded_vertex.h"

#include "core/base/units.h"
#include "core/mesh/contact_mesh.h"
#include "core/mesh/fan_walk.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr double kTurn = 360.0 * kDegree;

double angle_in(const CrowdedVertex::Run& run, const Vec3& d) {
  const double angle = std::atan2(glm::dot(d, run.y), glm::dot(d, run.x));
  return angle < 0.0 ? angle + kTurn : angle;
}

Vec3 edge_from(const ContactMesh& mesh, const CornerOfTriangle& c) {
  return mesh.position(c.triangle, next3(c.corner)) - mesh.position(c.triangle, c.corner);
}

void gather_ring(const ContactMesh& mesh, Corner at, CrowdedVertex& crowded) {
  const auto links = mesh.links();
  Corner first = at;
  for (Corner right = turn_right(links, at); !right.none() && right != at; right = turn_right(links, right))
    first = right;
  if (turn_right(links, first) == at) first = at;  // no boundary
  Corner c = first;
  do {
    crowded.ring.push_back({c.triangle, c.corner});
    c = turn_left(links, c);
  } while (!c.none() && c != first);
}

/// Starts the ring where a run does, so that none is cut in two.
void start_at_run(const ContactMesh& mesh, CrowdedVertex& crowded) {
  const FlatRegions& flat = mesh.flat_regions();
  const auto region = [&](const CornerOfTriangle& c) { return flat.of(c.triangle); };
  const auto links = mesh.links();
  const CornerOfTriangle& front = crowded.ring.front();
  if (turn_right(links, {front.triangle, front.corner}).none()) return;
  for (std::size_t i = 1; i < crowded.ring.size(); ++i)
    if (region(crowded.ring[i]) != region(crowded.ring[i - 1])) {
      std::rotate(crowded.ring.begin(), crowded.ring.begin() + static_cast<std::ptrdiff_t>(i), crowded.ring.end());
      return;
    }
}

void gather_runs(const ContactMesh& mesh, CrowdedVertex& crowded) {
  const FlatRegions& flat = mesh.flat_regions();
  double last = 0.0;
  for (std::uint32_t i = 0; i < crowded.ring.size(); ++i) {
    const std::uint32_t region = flat.of(crowded.ring[i].triangle);
    const Vec3 edge = edge_from(mesh, crowded.ring[i]);
    if (region == kNone || crowded.runs.empty() || crowded.runs.back().region != region) {
      CrowdedVertex::Run run{i, i, region, Vec3(0.0), Vec3(0.0), Vec3(0.0)};
      if (region != kNone) {
        run.normal = flat.normal(region);
        run.x = unit(edge);
        run.y = glm::cross(run.normal, run.x);
      }
      crowded.runs.push_back(run);
      last = 0.0;
    }
    CrowdedVertex::Run& run = crowded.runs.back();
    run.last = i + 1;
    if (i > run.first) last = std::max(last, angle_in(run, edge));
    crowded.angles.push_back(last);
  }
}

}  // namespace

std::array<std::uint32_t, 5> CrowdedVertex::towards(const Run& run, const Vec3& direction) const {
  const auto first = angles.begin() + run.first, last = angles.begin() + run.last;
  const auto above =
      static_cast<std::uint32_t>(std::upper_bound(first, last, angle_in(run, direction)) - angles.begin());
  const auto within = [&](std::uint32_t i) { return std::clamp(i, run.first, run.last - 1); };
  return {run.first, within(std::max(above, 2u) - 2), within(std::max(above, 1u) - 1), within(above), run.last - 1};
}

std::vector<CrowdedVertex> crowded_vertices(const ContactMesh& mesh) {
  std::vector<CrowdedVertex> all;
  const FlatRegions& flat = mesh.flat_regions();
  if (flat.empty()) return all;
  std::vector<std::uint32_t> met(mesh.vertex_count(), 0);
  for (std::uint32_t region = 0; region < flat.count(); ++region)
    for (const std::uint32_t t : flat.triangles(region))
      for (std::uint32_t k = 0; k < 3; ++k)
        if (mesh.feature_corner(t, k) && ++met[mesh.vertex(t, k)] == FlatRegions::kManySlivers) {
          CrowdedVertex crowded;
          crowded.vertex = mesh.vertex(t, k);
          gather_ring(mesh, {t, k}, crowded);
          start_at_run(mesh, crowded);
          gather_runs(mesh, crowded);
          all.push_back(std::move(crowded));
        }
  std::sort(all.begin(), all.end(), [](const CrowdedVertex& a, const CrowdedVertex& b) { return a.vertex < b.vertex; });
  return all;
}

}  // namespace tangent
