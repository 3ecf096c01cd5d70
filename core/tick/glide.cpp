#include "core/tick/glide.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/step_rule.h"
#include "core/contact/follow/vertex.h"
#include "core/contact/follow/walk.h"
#include "core/contact/search/rivals.h"
#include "core/finger/facing_normal.h"
#include "core/tick/render.h"

#include <algorithm>

namespace tangent {
namespace {

bool glides(const Preset& preset) {
  return is_round(preset.finger) && preset.solver.max_iterations > 0 && only_smooth(preset);
}

/// One Newton step within the triangle from `c`, the contact at glide.u, glide.v: then the contact there, in
/// glide.contact.
inline bool take_step(PatchCache& patches, const Preset& preset, const Vec3& centre, const PlaneContact& c,
                      IterationResult& now, Glide& glide) {
  const Stability stability = now.bend.at_height(c.height_m);
  const ParameterStep step =
      newton_step(now.sample, round_jacobian(now.sample, c.height_m), c, now.bend.area_m2 * stability.det);
  if (!trusts_newton(stability) || !is_short(step) || !stays_inside(glide.u, glide.v, step.da, step.db)) return false;
  ++glide.planes;
  glide.u += step.da;
  glide.v += step.db;
  patches.sample(now.plane.triangle, preset.solver.normal_form, glide.u, glide.v, now.sample);
  round_contact(round_radius_m(preset.finger), centre, now.sample.point, now.sample.normal, glide.contact);
  now.bend = normal_bend(now.sample);
  return true;
}

/// The steps after the first. Apart, and called: most ticks take one, and are quicker without a loop.
[[gnu::noinline]] bool take_more_steps(PatchCache& patches, const Preset& preset, const Vec3& centre,
                                       IterationResult& now, Glide& glide) {
  const int budget = std::min(kTrackBudget, preset.solver.max_iterations);
  while (!(glide.contact.error_m < preset.solver.tolerance_m)) {
    const PlaneContact here = glide.contact;
    if (glide.planes == budget || !take_step(patches, preset, centre, here, now, glide)) return false;
  }
  return true;
}

/// Newton's steps within the triangle. `now`: the kept plane's sample in, the last one's and how it bends out.
bool glide_on_face(PatchCache& patches, const Preset& preset, const Vec3& centre, IterationResult& now, Glide& glide) {
  const double tolerance = preset.solver.tolerance_m;
  glide.u = now.plane.u;
  glide.v = now.plane.v;
  PlaneContact kept;
  round_contact(round_radius_m(preset.finger), centre, now.sample.point, now.sample.normal, kept);
  if (kept.error_m < tolerance || !take_step(patches, preset, centre, kept, now, glide)) return false;
  if (!(glide.contact.error_m < tolerance) && !take_more_steps(patches, preset, centre, now, glide)) return false;
  return now.bend.at_height(glide.contact.height_m).stable();
}

/// Along a straight edge between flat sides: no iteration at all.
bool glide_on_uniform_edge(const EdgeFan& fan, const Preset& preset, const Vec3& centre, double f, IterationResult& now,
                           Glide& glide) {
  const double radius = round_radius_m(preset.finger), tolerance = preset.solver.tolerance_m;
  const Vec3 d = centre - now.sample.point;
  const double to = f + uniform_step(fan, d);
  const Vec2 uv = edge_point_uv(now.plane.side, to);
  const Vec3 point = uniform_point(fan, edge_fraction(now.plane.side, uv.x, uv.y));
  const Vec2 turn = turn_of(fan, centre - point);
  const Vec3 normal = uniform_normal(fan, turn);
  PlaneContact kept;
  round_contact(radius, centre, now.sample.point, now.sample.normal, kept);
  if (kept.error_m < tolerance || !(kept.height_m > 0.0) || !(to > 0.0 && to < 1.0) || !in_fan(fan, turn)) return false;
  round_contact(radius, centre, point, normal, glide.contact);
  glide.u = uv.x;
  glide.v = uv.y;
  glide.turn = turn;
  glide.planes = 1;
  uniform_sample(fan, point, turn, normal, now.sample);
  return glide.contact.error_m < tolerance && glide.contact.height_m > 0.0;
}

/// One Newton step along a curved edge, and the normal turned to face the finger there. `fan` goes along with the
/// contact. Apart, so that the compiler sees through the calls within.
[[gnu::noinline, gnu::flatten]] bool glide_on_curved_edge(CachedFan& slot, const Preset& preset,
                                                          const FingerPose& local, IterationResult& now, Glide& glide) {
  const double radius = round_radius_m(preset.finger), tolerance = preset.solver.tolerance_m;
  PlaneContact kept;
  round_contact(radius, local.position, now.sample.point, now.sample.normal, kept);
  const EdgeBend before = edge_bend(now.sample);
  const double to = slot.f + round_edge_step(before, kept.height_m, local.position - now.sample.point);
  if (kept.error_m < tolerance || !before.at_height(kept.height_m).stable() || !(to > 0.0 && to < 1.0)) return false;

  const Vec2 uv = edge_point_uv(now.plane.side, to);
  glide.u = uv.x;
  glide.v = uv.y;
  PatchCache::move(slot, edge_fraction(now.plane.side, uv.x, uv.y));
  const EdgeFan& fan = slot.fan;
  glide.turn = turn_of(fan, local.position - fan.point);
  if (!in_fan(fan, glide.turn)) return false;
  glide.planes = 1;
  edge_sample(fan, glide.turn, now.sample);
  round_contact(radius, local.position, now.sample.point, now.sample.normal, glide.contact);
  return glide.contact.error_m < tolerance && edge_bend(now.sample).at_height(glide.contact.height_m).stable();
}

bool glide_on_edge(PatchCache& patches, const Preset& preset, const FingerPose& local, IterationResult& now,
                   Glide& glide) {
  const double f = edge_fraction(now.plane.side, now.plane.u, now.plane.v);
  CachedFan& slot = patches.cached_fan(now.plane.triangle, now.plane.side, f, preset.solver.normal_form);
  const EdgeFan& fan = slot.fan;
  if (now.plane.turn == kNearTurn || now.plane.turn == fan.far)
    return false;  // wants to turn on into the face, perhaps
  return fan.uniform ? glide_on_uniform_edge(fan, preset, local.position, f, now, glide)
                     : glide_on_curved_edge(slot, preset, local, now, glide);
}

/// On a vertex that nothing draws the finger away from the normal turns to face it.
bool glide_on_vertex(PatchCache& patches, const Preset& preset, const FingerPose& local, const TrackedPlane& kept,
                     IterationResult& now, Glide& glide) {
  const double radius = round_radius_m(preset.finger), tolerance = preset.solver.tolerance_m;
  const ContactMesh& mesh = patches.mesh();
  const Vec3& point = mesh.position(kept.triangle, kept.side);
  const Vec3 normal = facing_normal(preset.finger, local, point, mesh.normal(kept.triangle, kept.side));
  PlaneContact before;
  round_contact(radius, local.position, point, kept.normal, before);
  round_contact(radius, local.position, point, normal, glide.contact);
  if (before.error_m < tolerance || !(glide.contact.error_m < tolerance) || !(glide.contact.height_m > 0.0))
    return false;
  IterationContext context{patches, preset.solver, preset.finger, local, Vec3(0.0), nullptr, 0};
  if (vertex_exit(context, kept).place) return false;
  glide.u = kept.u;
  glide.v = kept.v;
  glide.planes = 1;
  now.plane = kept;
  now.sample.point = point;
  now.sample.normal = normal;
  return true;
}

/// `now`: of the kept plane in, of the new one out.
bool glide_from(StepCache& cache, const Preset& preset, const FingerPose& local, const TrackedPlane& kept,
                IterationResult& now, Glide& glide) {
  if (kept.feature == Feature::vertex) return glide_on_vertex(cache.patches, preset, local, kept, now, glide);
  if (!cache.holds(kept, preset.solver.normal_form)) return false;
  return kept.feature == Feature::face ? glide_on_face(cache.patches, preset, local.position, now, glide)
                                       : glide_on_edge(cache.patches, preset, local, now, glide);
}

}  // namespace

bool glide(StepCache& cache, const Preset& preset, const FingerPose& local, const TickState& state, Glide& glide) {
  if (!glides(preset)) return false;
  const Clearance& known = state.clearance;
  const double gone = gone_m(known, preset.finger, local);
  if (!(gone <= known.free_m)) return false;  // something must be looked at, wherever this leads
  IterationResult& now = cache.smooth.contact;
  if (glide_from(cache, preset, local, state.plane, now, glide) &&
      glm::dot(state.plane.normal, now.sample.normal) >= kJumpCosine &&
      !rival_possible(known, gone, contact_rank(preset.finger, glide.contact) - preset.solver.switch_hysteresis_m))
    return true;
  if (glide.planes > 0) now.plane.feature = Feature::none;  // its sample isn't the kept plane's any more
  return false;
}

[[gnu::flatten]] TickOutput end_glide(StepCache& cache, const Preset& preset, const TickInput& input,
                                      const FingerSection& section, const Vec3& origin, const Glide& glide,
                                      TickState& state) {
  IterationResult& now = cache.smooth.contact;
  const Vec3 point = now.sample.point, normal = now.sample.normal;
  const RenderPlane plane{normal, glide.contact.penetration_m, 1.0};
  const Rendered rendered =
      render(preset, plane, section, finger_velocity(preset, input.finger.position, input.t_s, state));
  now.plane.u = state.plane.u = glide.u;
  now.plane.v = state.plane.v = glide.v;
  if (state.plane.feature == Feature::edge) {
    now.plane.turn = state.plane.turn = glide.turn;
    now.plane.normal = normal;
  }
  state.plane.point = state.last_converged.point = point;
  state.plane.normal = state.last_converged.normal = normal;
  state.last_converged_s = input.t_s;
  state.has_converged = 1;
  keep_pose(input.finger.position, input.t_s, state);
  return {.status = status_of(state.plane.feature, plane.penetration_m),
          .event = TickEvent::none,
          .triangle = state.plane.triangle,
          .u = glide.u,
          .v = glide.v,
          .contact = origin + point,
          .normal = normal,
          .penetration_m = plane.penetration_m,
          .force_n = rendered.force_n,
          .cld_m = rendered.cld_m,
          .error_m = glide.contact.error_m,
          .iterations = glide.planes,
          .triangle_changes = 0};
}

}  // namespace tangent
