#include "core/contact/follow/hollow.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tangent {
namespace {

constexpr double kOnEdge = 1e-9;  // barycentric

/// Whether a turn lies between those of the sides of a hollow fan, the other way round than in a convex one.
bool in_hollow_fan(const EdgeFan& fan, const Vec2& turn) {
  return fan.far.y < 0.0 && turn.y <= 0.0 && turn.x * fan.far.y <= turn.y * fan.far.x;
}

/// The shortest way that brings a ball out of two planes through a point; `d` from there to its centre.
Vec3 way_out(const Vec3& d, double radius_m, const Vec3& n1, const Vec3& n2) {
  const double b1 = radius_m - glm::dot(d, n1), b2 = radius_m - glm::dot(d, n2), c = glm::dot(n1, n2);
  const double det = 1.0 - c * c, along1 = b1 - c * b2, along2 = b2 - c * b1;
  if (!(along1 > 0.0)) return b2 * n2;
  if (!(along2 > 0.0)) return b1 * n1;
  return (along1 * n1 + along2 * n2) / det;
}

/// The plane that pushes the finger out by `way`: through its own point that is furthest in, led back by that.
void rest(ContactContext& context, const Vec3& way, int evaluations, IterationResult& result) {
  const double depth = std::sqrt(glm::dot(way, way));
  const Vec3 normal = way / depth, &centre = context.pose.position;
  const Vec3 point = centre + (depth - round_radius_m(context.finger)) * normal;
  result.plane.point = result.sample.point = point;
  result.plane.normal = result.sample.normal = normal;
  contact_on_plane(context.finger, context.pose, point, normal, result.contact);
  result.stability = {};
  result.bend = {};
  result.stop = StopReason::converged;
  result.evaluations = evaluations;
  result.triangle_changes = 0;
  result.met_unstable = false;
}

/// Where the centre is behind every face around the vertex, and along none of its edges nearer than there.
bool find_at_vertex(ContactContext& context, const SurfacePlace& vertex, int evaluations, IterationResult& result) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3& point = mesh.position(vertex.triangle, vertex.side);
  const Vec3 d = context.pose.position - point;
  if (!(glm::dot(d, d) > 0.0)) return false;
  bool rests = true, has_crease = false;
  context.cache.around(
      vertex.triangle, vertex.side, context.settings.normal_form, [&](const Vec3&) { return d; },
      [&](std::uint32_t, std::uint32_t, const SurfaceSample& sample) {
        rests = rests && glm::dot(d, sample.normal) < 0.0;
      },
      [&](std::uint32_t, std::uint32_t, double f, const EdgeFan& fan) {
        has_crease = true;
        rests = rests && fan.far.y < 0.0 && (f > 0.5 ? -1.0 : 1.0) * glm::dot(d, fan.point_f) <= 0.0;
      });
  if (!rests || !has_crease) return false;
  result.plane.move_to(vertex);
  const double off = std::sqrt(glm::dot(d, d));
  rest(context, -(1.0 + round_radius_m(context.finger) / off) * d, evaluations, result);
  return true;
}

SurfacePlace end_of(const SurfacePlace& edge, double f) {
  SurfacePlace vertex = edge;
  vertex.feature = Feature::vertex;
  vertex.side = static_cast<std::uint8_t>(f > 0.5 ? (edge.side + 1) % 3 : edge.side);
  const Vec2 uv = corner_uv(vertex.side);
  vertex.u = uv.x;
  vertex.v = uv.y;
  return vertex;
}

bool find_from_vertex(ContactContext& context, const SurfacePlace& vertex, int evaluations, IterationResult& result);

/// `along_others`: past its end it may go on along another.
bool find_on_edge(ContactContext& context, const SurfacePlace& edge, bool along_others, IterationResult& result) {
  constexpr int kSteps = 16;
  const ContactMesh& mesh = context.cache.mesh();
  if (mesh.edge_kind(edge.triangle, edge.side) != EdgeKind::crease) return false;
  double f = edge_fraction(edge.side, edge.u, edge.v);
  for (int i = 1; i <= kSteps; ++i) {
    const EdgeFan& fan = context.cache.fan(edge.triangle, edge.side, f, context.settings.normal_form);
    const Vec3 d = context.pose.position - fan.point;
    const double speed2 = glm::dot(fan.point_f, fan.point_f), along = glm::dot(d, fan.point_f);
    if (fan.convex() || !(speed2 > 0.0) || !(glm::dot(d, d) > 0.0)) return false;
    const double to = std::clamp(f + along / speed2, 0.0, 1.0), step = (to - f) * std::sqrt(speed2);
    if (std::abs(step) > 0.1 * context.settings.tolerance_m) {
      f = to;
      continue;
    }
    if ((f == 0.0 && along < 0.0) || (f == 1.0 && along > 0.0))
      return along_others ? find_from_vertex(context, end_of(edge, f), i, result)
                          : find_at_vertex(context, end_of(edge, f), i, result);
    const Vec2 turn = turn_of(fan, -d);
    if (!in_hollow_fan(fan, turn)) return false;
    const Vec3 way = way_out(d, round_radius_m(context.finger), fan.near_normal, fan.far_normal);
    result.plane.move_to(place_on_edge(edge.triangle, edge.side, f));
    result.plane.turn = turn;
    rest(context, way, i, result);
    return true;
  }
  return false;
}

/// On it, or on the crease that leads away from it towards the centre.
bool find_from_vertex(ContactContext& context, const SurfacePlace& vertex, int evaluations, IterationResult& result) {
  const ContactMesh& mesh = context.cache.mesh();
  if (!mesh.feature_corner(vertex.triangle, vertex.side)) return false;
  if (find_at_vertex(context, vertex, evaluations, result)) return true;
  const Vec3 d = context.pose.position - mesh.position(vertex.triangle, vertex.side);
  std::optional<SurfacePlace> crease;
  double most = 0.0;
  context.cache.around(
      vertex.triangle, vertex.side, context.settings.normal_form, [&](const Vec3&) { return d; },
      [](std::uint32_t, std::uint32_t, const SurfaceSample&) {},
      [&](std::uint32_t t, std::uint32_t side, double f, const EdgeFan& fan) {
        const double along = (f > 0.5 ? -1.0 : 1.0) * glm::dot(d, fan.point_f) / glm::length(fan.point_f);
        if (fan.convex() || !(along > most)) return;
        most = along;
        crease = place_on_edge(t, side, f);
      });
  if (!crease || !find_on_edge(context, *crease, false, result)) return false;
  result.evaluations += evaluations;
  return true;
}

}  // namespace

bool find_in_hollow(ContactContext& context, const SurfacePlace& start, IterationResult& result) {
  if (!is_round(context.finger)) return false;
  if (start.feature == Feature::edge) return find_on_edge(context, start, true, result);
  return start.feature == Feature::vertex && find_from_vertex(context, start, 1, result);
}

SurfacePlace feature_at(const ContactMesh& mesh, std::uint32_t t, double u, double v) {
  const double weights[3] = {1.0 - u - v, u, v};
  for (std::uint32_t k = 0; k < 3; ++k)
    if (weights[k] > 1.0 - kOnEdge && mesh.feature_corner(t, k)) {
      const Vec2 uv = corner_uv(k);
      return {Feature::vertex, static_cast<std::uint8_t>(k), t, uv.x, uv.y};
    }
  for (std::uint32_t k = 0; k < 3; ++k)
    if (weights[(k + 2) % 3] < kOnEdge && mesh.edge_kind(t, k) == EdgeKind::crease)
      return place_on_edge(t, k, std::clamp(edge_fraction(k, u, v), 0.0, 1.0));
  return {};
}

}  // namespace tangent
