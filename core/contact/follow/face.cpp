#include "core/contact/follow/face.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/walk.h"

namespace tangent {
namespace {

ParameterStep face_step(ContactContext& context, const IterationResult& now, const ContactJacobian& jacobian) {
  switch (context.settings.method) {
    case Method::newton:
      return newton_step(now.sample, jacobian, now.contact);
    case Method::robust:
      return robust_face_step(now.sample, jacobian, now.stability, now.contact, now.bend.area_m2);
    default:
      return paper_face_step(context.cache.mesh(), context.settings, now.plane.triangle, now.sample, now.contact);
  }
}

/// Walks from a face; false if the walk got lost.
bool move_on_face(const ContactContext& context, const ParameterStep& step, IterationResult& now) {
  if (stays_inside(now.plane.u, now.plane.v, step.da, step.db)) {
    now.plane.u += step.da;
    now.plane.v += step.db;
    return true;
  }
  const bool tracking = context.seed == 0 && context.settings.method == Method::robust;
  const WalkResult walk = walk_face(context.cache.mesh(), now.plane.triangle, now.plane.u, now.plane.v, step.da,
                                    step.db, tracking ? kMostTrackedCrossings : context.most_crossings);
  if (walk.lost) return false;  // the plane stays with its sample
  now.plane.move_to(walk.place);
  now.triangle_changes += walk.triangle_changes;
  return true;
}

double step_length(const ContactMesh& mesh, std::uint32_t t, const ParameterStep& step) {
  const Vec3 s =
      step.da * (mesh.position(t, 1) - mesh.position(t, 0)) + step.db * (mesh.position(t, 2) - mesh.position(t, 0));
  return std::sqrt(glm::dot(s, s));
}

}  // namespace

bool iterate_face(ContactContext& context, int budget, RunMemory& memory, IterationResult& now) {
  const bool exact = now.contact.error_m < context.settings.tolerance_m, round = is_round(context.finger);
  ContactJacobian jacobian;
  if (!exact || !round) jacobian = contact_jacobian(context.finger, context.pose, now.sample, now.contact);
  now.stability = round ? now.bend.at_height(now.contact.height_m) : face_stability(now.sample, jacobian);
  if (exact) {
    now.stop = context.settings.method == Method::robust && !now.stability.stable() ? StopReason::unstable
                                                                                    : StopReason::converged;
    if (context.trace) record(context, now, ParameterStep{}, 0.0, now.stop);
    return false;
  }
  ParameterStep step = face_step(context, now, jacobian);
  if (!round && context.settings.method == Method::robust && step.valid) memory.rein_in(now, step);
  const ContactMesh& mesh = context.cache.mesh();
  now.stop = step.valid ? StopReason::going_on : StopReason::singular_patch;
  if (step.valid && now.evaluations >= budget) now.stop = why_unconverged(mesh, now, memory, budget);
  if (context.trace) record(context, now, step, step_length(mesh, now.plane.triangle, step), now.stop);
  if (now.stop != StopReason::going_on) return false;
  if (move_on_face(context, step, now)) return true;
  now.stop = StopReason::too_far;
  if (context.trace) context.trace->amend_last(now.stop);
  return false;
}

}  // namespace tangent
