#include "core/contact/follow/walk.h"

#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

struct Weights {
  double w[3];  // of corners 0, 1, 2
};

/// Edge k is where the weight of this corner is zero.
constexpr std::uint32_t opposite_corner(std::uint32_t edge) { return (edge + 2) % 3; }

/// In-plane unit vector from edge k towards the opposite corner, zero for a degenerate triangle.
Vec3 inward(const ContactMesh& mesh, std::uint32_t t, std::uint32_t edge, const Vec3& edge_unit) {
  const Vec3 to_corner = mesh.position(t, opposite_corner(edge)) - mesh.position(t, edge);
  const Vec3 perpendicular = to_corner - glm::dot(to_corner, edge_unit) * edge_unit;
  const double length = std::sqrt(glm::dot(perpendicular, perpendicular));
  return length > 0.0 ? perpendicular / length : Vec3(0.0);
}

/// First edge that the segment w -> w + dw leaves the triangle by, other than `entered`; 3 if it stays inside.
std::uint32_t first_exit(const Weights& w, const Weights& dw, std::uint32_t entered, double& share) {
  std::uint32_t exit = 3;
  share = 1.0;
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    const std::uint32_t corner = opposite_corner(edge);
    if (edge == entered || w.w[corner] + dw.w[corner] >= 0.0 || dw.w[corner] >= 0.0) continue;
    const double s = std::max(0.0, w.w[corner] / -dw.w[corner]);
    if (s < share || (exit == 3 && s <= share)) {
      share = s;
      exit = edge;
    }
  }
  return exit;
}

/// Crossings after which a walk over a region of slivers goes to its end at once.
constexpr int kJump = 16;

/// The end of a step from (u, v) over the region of t: the place there, or where none is, the region's nearest.
SurfacePlace end_on_region(const ContactMesh& mesh, std::uint32_t t, const Vec2& uv, const Vec2& step) {
  const Vec3& p = mesh.position(t, 0);
  const Vec2 to = uv + step;
  const Vec3 target = p + to.x * (mesh.position(t, 1) - p) + to.y * (mesh.position(t, 2) - p);
  const RegionFoot foot = mesh.flat_regions().foot(mesh, mesh.flat_regions().of(t), target);
  const double weights[3] = {1.0 - foot.u - foot.v, foot.u, foot.v};
  for (std::uint32_t edge = 0; edge < 3 && foot.beside_m > 0.0; ++edge) {
    const EdgeKind kind = mesh.edge_kind(foot.triangle, edge);
    if (weights[opposite_corner(edge)] > 1e-12 || kind == EdgeKind::smooth) continue;
    if (kind == EdgeKind::crease && mesh.concave_crease(foot.triangle, edge)) continue;
    return place_on_edge(foot.triangle, edge, std::clamp(edge_fraction(edge, foot.u, foot.v), 0.0, 1.0));
  }
  return place_on_face(foot.triangle, foot.u, std::min(foot.v, 1.0 - foot.u));
}

}  // namespace

bool to_barycentric(const ContactMesh& mesh, std::uint32_t t, const Vec3& vector, double& du, double& dv) {
  // Orthogonalise against the longer side, so that slivers keep their digits.
  const Vec3& p = mesh.position(t, 0);
  Vec3 a = mesh.position(t, 1) - p, b = mesh.position(t, 2) - p;
  const bool swapped = glm::dot(b, b) > glm::dot(a, a);
  if (swapped) std::swap(a, b);
  const double a2 = glm::dot(a, a);
  if (!(a2 > 0.0)) return false;
  const double slope = glm::dot(a, b) / a2;
  const Vec3 height = b - slope * a;
  const double height2 = glm::dot(height, height);
  if (!(height2 > 0.0)) return false;
  const double of_b = glm::dot(vector, height) / height2;
  const double of_a = glm::dot(vector, a) / a2 - slope * of_b;
  du = swapped ? of_b : of_a;
  dv = swapped ? of_a : of_b;
  return true;
}

std::optional<SurfacePlace> walk_past_end(const ContactMesh& mesh, std::uint32_t t, std::uint32_t edge, bool forwards,
                                          double beyond_m) {
  constexpr double kStraight = 0.866;
  const std::uint32_t corner = forwards ? (edge + 1) % 3 : edge, from = forwards ? edge : (edge + 1) % 3;
  const std::uint32_t origin = mesh.vertex(t, from);
  const Vec3& here = mesh.position(t, corner);
  const Vec3 heading = here - mesh.position(t, from);
  std::optional<SurfacePlace> next;
  int edges = 0;
  const auto offer = [&](std::uint32_t at, std::uint32_t k, bool starts_here) {
    const std::uint32_t end = starts_here ? (k + 1) % 3 : k;
    if (mesh.vertex(at, end) == origin) return;
    ++edges;
    const Vec3 on = mesh.position(at, end) - here;
    const double length = glm::length(on);
    if (!(glm::dot(on, heading) > kStraight * length * glm::length(heading))) return;
    const double f = std::min(1.0, beyond_m / length);
    next = place_on_edge(at, k, starts_here ? f : 1.0 - f);
  };
  around_vertex_towards(
      mesh, t, corner, [&](const Vec3&) { return heading; },
      [&](std::uint32_t at, std::uint32_t k) {
        if (mesh.edge_kind(at, k) != EdgeKind::smooth) offer(at, k, true);
        const std::uint32_t ending = (k + 2) % 3;  // inner edges start here in another triangle
        if (mesh.edge_kind(at, ending) == EdgeKind::boundary) offer(at, ending, false);
      });
  return edges == 1 ? next : std::nullopt;
}

WalkResult walk_face(const ContactMesh& mesh, std::uint32_t t, double u, double v, double du, double dv,
                     int most_crossings) {
  WalkResult result;
  result.place.feature = Feature::face;
  std::uint32_t entered = 3;
  for (int crossing = 0; crossing <= most_crossings; ++crossing) {
    if (crossing == kJump && mesh.flat_regions().of(t) != kNone) {
      result.place = end_on_region(mesh, t, {u, v}, {du, dv});
      return result;
    }
    const Weights w{{1.0 - u - v, u, v}}, dw{{-du - dv, du, dv}};
    double share = 1.0;
    const std::uint32_t exit = first_exit(w, dw, entered, share);
    if (exit == 3) {
      result.place.triangle = t;
      // Rounding must not leave the triangle: the next walk starts here.
      result.place.u = std::clamp(u + du, 0.0, 1.0);
      result.place.v = std::clamp(v + dv, 0.0, 1.0 - result.place.u);
      return result;
    }
    const double f = std::clamp(edge_fraction(exit, u + share * du, v + share * dv), 0.0, 1.0);
    const EdgeKind kind = mesh.edge_kind(t, exit);
    if (kind == EdgeKind::boundary || (kind == EdgeKind::crease && !mesh.concave_crease(t, exit))) {
      result.place = place_on_edge(t, exit, f);
      return result;
    }
    const EdgeLink other = mesh.across(t, exit);
    mesh.prefetch(other.triangle);
    // Unfold: keep what is left of the step along and across the edge, across now into the neighbour.
    const Vec3 left = (1.0 - share) * (du * (mesh.position(t, 1) - mesh.position(t, 0)) +
                                       dv * (mesh.position(t, 2) - mesh.position(t, 0)));
    const Vec3 edge_vector = mesh.position(t, (exit + 1) % 3) - mesh.position(t, exit);
    const Vec3 edge_unit = unit(edge_vector);
    const double along = glm::dot(left, edge_unit);
    const double across = std::max(0.0, -glm::dot(left, inward(mesh, t, exit, edge_unit)));
    const Vec3 unfolded = along * edge_unit + across * inward(mesh, other.triangle, other.edge, edge_unit);
    t = other.triangle;
    entered = other.edge;
    const Vec2 uv = edge_point_uv(entered, 1.0 - f);
    u = uv.x;
    v = uv.y;
    ++result.triangle_changes;
    if (!to_barycentric(mesh, t, unfolded, du, dv)) break;
  }
  result.lost = true;
  result.place.triangle = t;
  result.place.u = std::clamp(u, 0.0, 1.0);
  result.place.v = std::clamp(v, 0.0, 1.0 - result.place.u);
  return result;
}

}  // namespace tangent
