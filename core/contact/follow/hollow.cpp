#include "core/contact/follow/hollow.h"

#include "core/finger/facing_normal.h"
#include "core/mesh/vertex_ring.h"

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

/// Whether the contact with each side has passed the edge, of a round finger where its centre is behind both; `d` from
/// the edge to that.
bool is_past_both(const ContactContext& context, const EdgeFan& fan, const Vec3& d) {
  if (is_round(context.finger)) return in_hollow_fan(fan, turn_of(fan, -d));
  const Vec3 from_far = fan.far.x * fan.e2 - fan.far.y * fan.e1;  // as e2 from the near side; into the far one
  const auto past = [&](const Vec3& normal, const Vec3& across) {
    return glm::dot(contact_on_plane(context.finger, context.pose, fan.point, normal).travel, across);
  };
  return past(fan.near_normal, fan.e2) >= 0.0 && past(fan.far_normal, from_far) <= 0.0;
}

/// The shortest way that brings the finger out of both sides.
Vec3 way_out(const ContactContext& context, const EdgeFan& fan) {
  const Vec3 &n1 = fan.near_normal, &n2 = fan.far_normal;
  const double b1 = contact_on_plane(context.finger, context.pose, fan.point, n1).penetration_m;
  const double b2 = contact_on_plane(context.finger, context.pose, fan.point, n2).penetration_m;
  const double c = glm::dot(n1, n2), det = 1.0 - c * c, along1 = b1 - c * b2, along2 = b2 - c * b1;
  if (!(along1 > 0.0)) return b2 * n2;
  if (!(along2 > 0.0)) return b1 * n1;
  return (along1 * n1 + along2 * n2) / det;
}

/// How far the place is from being the finger's along the edge, times |point_f|: the way of the contact that is pushed
/// out so, of a round finger that of its centre.
double way_along(const ContactContext& context, const EdgeFan& fan, const Vec3& d) {
  if (is_round(context.finger)) return glm::dot(d, fan.point_f);
  const Vec3 way = way_out(context, fan);
  if (way == Vec3(0.0)) return 0.0;
  return glm::dot(contact_on_plane(context.finger, context.pose, fan.point, unit(way)).travel, fan.point_f);
}

/// The plane that pushes the finger out by `way`: through its own point that is furthest in, led back by that.
void rest(ContactContext& context, const Vec3& way, int evaluations, IterationResult& result) {
  const double depth = std::sqrt(glm::dot(way, way));
  const Vec3 normal = way / depth;
  const Vec3 furthest = is_round(context.finger) ? context.pose.position - round_radius_m(context.finger) * normal
                                                 : support_point(context.finger, context.pose, normal);
  const Vec3 point = furthest + way;
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

/// From a point to the centre of a round finger; of others against the normal of the plane through it whose contact it
/// is. Zero where that is nowhere.
Vec3 seen_from_behind(const ContactContext& context, const Vec3& point) {
  const Vec3 d = context.pose.position - point;
  if (is_round(context.finger) || d == Vec3(0.0)) return d;
  return -facing_normal(context.finger, context.pose, point, unit(-d), FacingSide::back);
}

/// Where the centre is behind every face around the vertex, and along none of its edges nearer than there.
bool find_at_vertex(ContactContext& context, const SurfacePlace& vertex, int evaluations, IterationResult& result) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3& point = mesh.position(vertex.triangle, vertex.side);
  const Vec3 d = seen_from_behind(context, point);
  if (d == Vec3(0.0)) return false;
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
  const Vec3 normal = unit(-d);
  const double depth = contact_on_plane(context.finger, context.pose, point, normal).penetration_m;
  if (!rests || !has_crease || !(depth > 0.0)) return false;
  result.plane.move_to(vertex);
  rest(context, depth * normal, evaluations, result);
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
    const double speed2 = glm::dot(fan.point_f, fan.point_f);
    if (fan.convex() || !(speed2 > 0.0) || !(glm::dot(d, d) > 0.0)) return false;
    const bool past_both = is_past_both(context, fan, d);
    if (!past_both && !is_round(context.finger)) return false;
    const double along = way_along(context, fan, d);
    const double to = std::clamp(f + along / speed2, 0.0, 1.0), step = (to - f) * std::sqrt(speed2);
    if (std::abs(step) > 0.1 * context.settings.tolerance_m) {
      f = to;
      continue;
    }
    if ((f == 0.0 && along < 0.0) || (f == 1.0 && along > 0.0))
      return along_others ? find_from_vertex(context, end_of(edge, f), i, result)
                          : find_at_vertex(context, end_of(edge, f), i, result);
    const Vec3 way = way_out(context, fan);
    if (!past_both || way == Vec3(0.0)) return false;
    result.plane.move_to(place_on_edge(edge.triangle, edge.side, f));
    result.plane.turn = turn_of(fan, way);
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
  const Vec3 d = seen_from_behind(context, mesh.position(vertex.triangle, vertex.side));
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
  if (start.feature == Feature::edge) return find_on_edge(context, start, true, result);
  return start.feature == Feature::vertex && find_from_vertex(context, start, 1, result);
}

bool is_hollow(const ContactMesh& mesh, const SurfacePlace& place) {
  if (place.feature == Feature::edge)
    return mesh.edge_kind(place.triangle, place.side) == EdgeKind::crease &&
           mesh.concave_crease(place.triangle, place.side);
  if (place.feature != Feature::vertex) return false;
  bool hollow = false;
  around_vertex(mesh, place.triangle, place.side, [&](std::uint32_t t, std::uint32_t k) {
    hollow = hollow || (mesh.edge_kind(t, k) == EdgeKind::crease && mesh.concave_crease(t, k));
  });
  return hollow;
}

std::array<SurfacePlace, 2> sides_of(const ContactMesh& mesh, const SurfacePlace& edge) {
  const double f = edge_fraction(edge.side, edge.u, edge.v);
  const EdgeLink other = mesh.across(edge.triangle, edge.side);
  const Vec2 there = edge_point_uv(other.edge, 1.0 - f);
  return {place_on_face(edge.triangle, edge.u, edge.v), place_on_face(other.triangle, there.x, there.y)};
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
