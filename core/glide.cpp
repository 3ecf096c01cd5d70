#include "core/glide.h"

#include "core/base/tolerances.h"
#include "core/contact/facing_normal.h"
#include "core/contact/rivals.h"
#include "core/contact/step_rule.h"
#include "core/contact/vertex_fan.h"
#include "core/contact/walk.h"
#include "core/shading/render.h"

namespace tangent {
namespace {

bool glides(const Preset& preset) {
  return preset.solver.method == Method::robust && is_round(preset.finger) && preset.solver.max_iterations > 0 && only_smooth(preset);
}

/// One Newton step within the triangle. `now`: the kept plane in, the new sample and how it bends out.
bool glide_on_face(PatchCache& patches, const Preset& preset, const Vec3& centre, IterationResult& now, Glide& glide) {
  const double radius = round_radius_m(preset.finger), tolerance = preset.solver.tolerance_m;
  PlaneContact kept;
  round_contact(radius, centre, now.sample.point, now.sample.normal, kept);
  const Stability before = now.bend.at_height(kept.height_m);
  const ParameterStep step = newton_step(now.sample, round_jacobian(now.sample, kept.height_m), kept, now.bend.area_m2 * before.det);
  if (kept.error_m < tolerance || !trusts_newton(before) || !is_short(step) || !stays_inside(now.plane.u, now.plane.v, step.da, step.db))
    return false;

  glide.u = now.plane.u + step.da;
  glide.v = now.plane.v + step.db;
  patches.sample(now.plane.triangle, preset.solver.normal_form, glide.u, glide.v, now.sample);
  round_contact(radius, centre, now.sample.point, now.sample.normal, glide.contact);
  now.bend = normal_bend(now.sample);
  return glide.contact.error_m < tolerance && now.bend.at_height(glide.contact.height_m).stable();
}

/// Along a straight edge between flat sides: no iteration at all.
bool glide_on_uniform_edge(const EdgeFan& fan, const Preset& preset, const Vec3& centre, double f, IterationResult& now, Glide& glide) {
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
  uniform_sample(fan, point, turn, normal, now.sample);
  return glide.contact.error_m < tolerance && glide.contact.height_m > 0.0;
}

/// One Newton step along a curved edge, and the normal turned to face the finger there. `fan` goes along with the contact.
bool glide_on_curved_edge(PatchCache& patches, const EdgeFan& fan, const Preset& preset, const FingerPose& local, double f, IterationResult& now,
                          Glide& glide) {
  const double radius = round_radius_m(preset.finger), tolerance = preset.solver.tolerance_m;
  PlaneContact kept;
  round_contact(radius, local.position, now.sample.point, now.sample.normal, kept);
  const ContactJacobian before = round_jacobian(now.sample, kept.height_m);
  const double to = f + newton_step(now.sample, before, kept).da;
  if (kept.error_m < tolerance || !edge_stability(fan, now.sample, before).stable() || !(to > 0.0 && to < 1.0)) return false;

  const Vec2 uv = edge_point_uv(now.plane.side, to);
  glide.u = uv.x;
  glide.v = uv.y;
  patches.fan(now.plane.triangle, now.plane.side, edge_fraction(now.plane.side, uv.x, uv.y), preset.solver.normal_form);
  glide.turn = facing_turn(fan, preset.finger, local);
  if (!in_fan(fan, glide.turn)) return false;
  edge_sample(fan, glide.turn, now.sample);
  round_contact(radius, local.position, now.sample.point, now.sample.normal, glide.contact);
  return glide.contact.error_m < tolerance && edge_stability(fan, now.sample, round_jacobian(now.sample, glide.contact.height_m)).stable();
}

bool glide_on_edge(PatchCache& patches, const Preset& preset, const FingerPose& local, IterationResult& now, Glide& glide) {
  const double f = edge_fraction(now.plane.side, now.plane.u, now.plane.v);
  const EdgeFan& fan = patches.fan(now.plane.triangle, now.plane.side, f, preset.solver.normal_form);
  if (now.plane.turn == kNearTurn || now.plane.turn == fan.far) return false;  // wants to turn on into the face, perhaps
  return fan.uniform ? glide_on_uniform_edge(fan, preset, local.position, f, now, glide)
                     : glide_on_curved_edge(patches, fan, preset, local, f, now, glide);
}

/// On a vertex that nothing draws the finger away from the normal turns to face it.
bool glide_on_vertex(PatchCache& patches, const Preset& preset, const FingerPose& local, const TrackedPlane& kept, IterationResult& now, Glide& glide) {
  const double radius = round_radius_m(preset.finger), tolerance = preset.solver.tolerance_m;
  const ContactMesh& mesh = patches.mesh();
  const Vec3& point = mesh.position(kept.triangle, kept.side);
  const Vec3 normal = facing_normal(preset.finger, local, point, mesh.normal(kept.triangle, kept.side));
  PlaneContact before;
  round_contact(radius, local.position, point, kept.normal, before);
  round_contact(radius, local.position, point, normal, glide.contact);
  if (before.error_m < tolerance || !(glide.contact.error_m < tolerance) || !(glide.contact.height_m > 0.0)) return false;
  IterationContext context{patches, preset.solver, preset.finger, local, Vec3(0.0), nullptr, 0};
  if (vertex_exit(context, kept).place) return false;
  glide.u = kept.u;
  glide.v = kept.v;
  now.plane = kept;
  now.sample.point = point;
  now.sample.normal = normal;
  return true;
}

/// `now`: of the kept plane in, of the new one out, if true; otherwise it is spoilt.
bool glide_from(StepCache& cache, const Preset& preset, const FingerPose& local, const TrackedPlane& kept, IterationResult& now, Glide& glide) {
  if (kept.feature == Feature::vertex) return glide_on_vertex(cache.patches, preset, local, kept, now, glide);
  if (!cache.holds(kept, preset.solver.normal_form)) return false;
  return kept.feature == Feature::face ? glide_on_face(cache.patches, preset, local.position, now, glide)
                                       : glide_on_edge(cache.patches, preset, local, now, glide);
}

}  // namespace

bool glide(StepCache& cache, const Preset& preset, const FingerPose& local, const TickState& state, Glide& glide) {
  if (!glides(preset)) return false;
  IterationResult& now = cache.smooth.contact;
  if (glide_from(cache, preset, local, state.plane, now, glide) && glm::dot(state.plane.normal, now.sample.normal) >= kJumpCosine &&
      !rival_possible(state.clearance, gone_m(state.clearance, preset.finger, local),
                      contact_rank(preset.finger, glide.contact) - preset.solver.switch_hysteresis_m))
    return true;
  now.plane.feature = Feature::none;  // its sample may not be the kept plane's any more
  return false;
}

TickOutput end_glide(StepCache& cache, const Preset& preset, const TickInput& input, const Vec3& origin, const Glide& glide, TickState& state) {
  IterationResult& now = cache.smooth.contact;
  const Vec3 point = now.sample.point, normal = now.sample.normal;
  const RenderPlane plane{normal, glide.contact.penetration_m, 1.0};
  const Rendered rendered = render(preset, plane, input.finger, finger_velocity(preset, input.finger.position, input.t_s, state));
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
          .iterations = 1,
          .triangle_changes = 0};
}

}  // namespace tangent
