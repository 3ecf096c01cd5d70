#include "core/contact/vertex_fan.h"

#include "core/contact/facing_normal.h"
#include "core/contact/step_rule.h"
#include "core/contact/walk.h"
#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

Vec2 corner_uv(std::uint32_t corner) { return {corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0}; }

/// How strongly the face draws the contact from its corner into itself: length of the step if that leads
/// inside, else 0.
double face_pull(IterationContext& context, std::uint32_t t, std::uint32_t corner) {
  const Vec2 uv = corner_uv(corner);
  const SurfaceSample s = evaluate(context.cache.patch(t, context.settings.normal_form), uv.x, uv.y);
  const PlaneContact c = contact_on_plane(context.finger, context.pose, s.point, s.normal);
  const ContactJacobian j = contact_jacobian(context.finger, context.pose, s, c);
  ParameterStep step = context.settings.method == Method::paper
                           ? paper_face_step(context.cache.mesh(), context.settings, t, s, c)
                           : robust_face_step(s, j, face_stability(s, j), c, glm::dot(s.point_u, glm::cross(s.point_v, s.normal)));
  if (!step.valid) return 0.0;
  const double change[3] = {-step.da - step.db, step.da, step.db};
  // Along a side it still leads inside: on a symmetry line of the mesh no triangle would have it otherwise.
  const double a = change[(corner + 1) % 3], b = change[(corner + 2) % 3], forward = std::max(a, b);
  if (forward <= 0.0 || std::min(a, b) < -1e-9 * forward) return 0.0;
  const Vec3 ds = step.da * s.point_u + step.db * s.point_v;
  return std::sqrt(glm::dot(ds, ds));
}

/// The same for a crease or boundary edge that starts (f = 0) or ends (f = 1) at the vertex.
double edge_pull(IterationContext& context, std::uint32_t t, std::uint32_t edge, double f) {
  const EdgeFan& fan = context.cache.fan(t, edge, f, context.settings.normal_form);
  if (!fan.convex()) return 0.0;
  const Vec2 turn = facing_turn(fan, context.finger, context.pose);
  if (!in_fan(fan, turn)) return 0.0;
  SurfaceSample s;
  edge_sample(fan, turn, s);
  const PlaneContact c = contact_on_plane(context.finger, context.pose, s.point, s.normal);
  const double away = glm::dot(c.travel, fan.tangent) * (f == 0.0 ? 1.0 : -1.0);
  return away > 0.0 ? away : 0.0;
}

}  // namespace

namespace {

/// A sample that stands still at `point` while its normal turns freely.
SurfaceSample standing_sample(const Vec3& point, const Vec3& normal) {
  SurfaceSample s{};
  s.point = point;
  s.normal = normal;
  const Vec3 axis = std::abs(normal.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  s.normal_u = unit(glm::cross(normal, axis));
  s.normal_v = glm::cross(normal, s.normal_u);
  s.point_u = s.point_v = Vec3(0.0);
  return s;
}

}  // namespace

SurfaceSample vertex_sample_at(IterationContext& context, const SurfacePlace& vertex, const Vec3& normal) {
  return standing_sample(context.cache.mesh().position(vertex.triangle, vertex.side), normal);
}

SurfaceSample vertex_sample(IterationContext& context, const SurfacePlace& vertex) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3& point = mesh.position(vertex.triangle, vertex.side);
  return vertex_sample_at(context, vertex, facing_normal(context.finger, context.pose, point, mesh.normal(vertex.triangle, vertex.side)));
}

VertexExit vertex_exit(IterationContext& context, const SurfacePlace& vertex) {
  const ContactMesh& mesh = context.cache.mesh();
  VertexExit best;
  double strongest = 1e-9 * std::max(context.finger.reach_m(), glm::length(mesh.bounds().size()));
  strongest = std::min(strongest, 0.1 * context.settings.tolerance_m);
  const auto offer = [&](double pull, const SurfacePlace& place) {
    if (!(pull > strongest)) return;
    strongest = pull;
    best.place = place;
  };
  around_vertex(mesh, vertex.triangle, vertex.side, [&](std::uint32_t t, std::uint32_t corner) {
    SurfacePlace place;
    place.triangle = t;
    const Vec2 uv = corner_uv(corner);
    place.u = uv.x;
    place.v = uv.y;
    place.feature = Feature::face;
    offer(face_pull(context, t, corner), place);
    place.feature = Feature::edge;
    // Each edge once: the one that starts here, and the one that ends here where nothing lies beyond it.
    if (mesh.edge_kind(t, corner) != EdgeKind::smooth) {
      place.side = static_cast<std::uint8_t>(corner);
      offer(edge_pull(context, t, corner, 0.0), place);
    }
    const std::uint32_t ending = (corner + 2) % 3;
    if (mesh.edge_kind(t, ending) == EdgeKind::boundary) {
      place.side = static_cast<std::uint8_t>(ending);
      offer(edge_pull(context, t, ending, 1.0), place);
    }
  });
  return best;
}

}  // namespace tangent
