#include "core/contact/follow/vertex.h"

#include "core/finger/facing_normal.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tangent {
namespace {

/// On flat ground every method steps along the travel. Where that turns away from both sides of the corner it leads
/// nowhere between them: a t1 + b t2 with a, b >= 0 has no negative product with both t1 and t2.
bool turns_from_flat(const Vec3& travel, std::uint32_t corner, const SurfaceSample& s) {
  if (s.normal_u != Vec3(0.0) || s.normal_v != Vec3(0.0)) return false;
  const Vec3 across = s.point_v - s.point_u;
  const Vec3 first = corner == 0 ? s.point_u : corner == 1 ? across : -s.point_v;
  const Vec3 second = corner == 0 ? s.point_v : corner == 1 ? -s.point_u : -across;
  return glm::dot(travel, first) <= 0.0 && glm::dot(travel, second) <= 0.0;
}

/// How strongly the face draws the contact from its corner, where its sample is `s`, into itself: length of the step if
/// that leads inside, else 0.
double face_pull(ContactContext& context, std::uint32_t t, std::uint32_t corner, const SurfaceSample& s) {
  const PlaneContact c = contact_on_plane(context.finger, context.pose, s.point, s.normal);
  if (turns_from_flat(c.travel, corner, s)) return 0.0;
  const ContactJacobian j = contact_jacobian(context.finger, context.pose, s, c);
  ParameterStep step =
      context.settings.method == Method::paper
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
double edge_pull(ContactContext& context, const EdgeFan& fan, double f) {
  if (!fan.convex()) return 0.0;
  const double outwards = f == 0.0 ? 1.0 : -1.0;
  if (fan.uniform && is_round(context.finger) &&
      outwards * glm::dot(context.pose.position - fan.point, fan.tangent) <= 0.0)
    return 0.0;
  const Vec2 turn = facing_turn(fan, context.finger, context.pose);
  if (!in_fan(fan, turn)) return 0.0;
  SurfaceSample s;
  edge_sample(fan, turn, s);
  const PlaneContact c = contact_on_plane(context.finger, context.pose, s.point, s.normal);
  const double away = outwards * glm::dot(c.travel, fan.tangent);
  return away > 0.0 ? away : 0.0;
}

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

SurfaceSample vertex_sample_at(ContactContext& context, const SurfacePlace& vertex, const Vec3& normal) {
  return standing_sample(context.cache.mesh().position(vertex.triangle, vertex.side), normal);
}

SurfaceSample vertex_sample(ContactContext& context, const SurfacePlace& vertex) {
  const ContactMesh& mesh = context.cache.mesh();
  const Vec3& point = mesh.position(vertex.triangle, vertex.side);
  return vertex_sample_at(
      context, vertex, facing_normal(context.finger, context.pose, point, mesh.normal(vertex.triangle, vertex.side)));
}

namespace {

/// Looks for the strongest pull away from a vertex.
class ExitSearch {
 public:
  explicit ExitSearch(ContactContext& context) : context_(context) {
    const double size = std::max(context.finger.reach_m(), glm::length(context.cache.mesh().bounds().size()));
    strongest_ = std::min(1e-9 * size, 0.1 * context.settings.tolerance_m);
  }

  void face(std::uint32_t t, std::uint32_t corner, const SurfaceSample& sample) {
    offer(face_pull(context_, t, corner, sample), Feature::face, t, 0, corner_uv(corner));
  }
  void ray(std::uint32_t t, std::uint32_t side, double f, const EdgeFan& fan) {
    offer(edge_pull(context_, fan, f), Feature::edge, t, side, edge_point_uv(side, f));
  }
  const std::optional<SurfacePlace>& best() const { return best_; }

 private:
  void offer(double pull, Feature feature, std::uint32_t t, std::uint32_t side, const Vec2& uv) {
    if (!(pull > strongest_)) return;
    strongest_ = pull;
    best_ = SurfacePlace{feature, static_cast<std::uint8_t>(side), t, uv.x, uv.y};
  }

  ContactContext& context_;
  double strongest_;
  std::optional<SurfacePlace> best_;
};

/// The edge or face around a vertex that draws the contact most; none: it rests.
std::optional<SurfacePlace> exit_from(ContactContext& context, const SurfacePlace& vertex) {
  ExitSearch search(context);
  const Vec3& point = context.cache.mesh().position(vertex.triangle, vertex.side);
  context.cache.around(
      vertex.triangle, vertex.side, context.settings.normal_form,
      [&](const Vec3& normal) { return contact_on_plane(context.finger, context.pose, point, normal).travel; },
      [&](std::uint32_t t, std::uint32_t corner, const SurfaceSample& sample) { search.face(t, corner, sample); },
      [&](std::uint32_t t, std::uint32_t side, double f, const EdgeFan& fan) { search.ray(t, side, f, fan); });
  return search.best();
}

}  // namespace

Proposal next_from_vertex(ContactContext& context, const SurfacePlace& at, RunMemory& memory, IterationResult& now,
                          bool kept) {
  Proposal next;
  now.stability = now.contact.height_m > 0.0 ? Stability{1.0, 2.0} : Stability{0.0, 0.0};
  std::optional<SurfacePlace> exit;
  if (memory.no_exit_triangle != at.triangle || memory.no_exit_corner != at.side) exit = exit_from(context, at);
  next.step.valid = true;
  if (!exit) {
    memory.no_exit_triangle = at.triangle;
    memory.no_exit_corner = at.side;
    if (now.contact.error_m < context.settings.tolerance_m) {
      next.stop = now.stability.stable() ? StopReason::converged : StopReason::unstable;
    } else if (kept) {
      next.place = at;  // turn the kept plane to face the finger
    } else {
      next.stop = StopReason::singular_patch;
    }
    return next;
  }
  next.place = *exit;
  next.triangle_changes = exit->triangle != at.triangle ? 1 : 0;
  return next;
}

}  // namespace tangent
