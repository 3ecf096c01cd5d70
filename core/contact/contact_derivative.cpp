#include "core/contact/contact_derivative.h"

#include "core/contact/follow/iterate.h"
#include "core/contact/follow/step_rule.h"

namespace tangent {

ContactDerivative contact_derivative(const ContactScene& scene, const Preset& preset, const FingerPose& pose,
                                     const TrackedPlane& plane) {
  ContactDerivative d;
  if (plane.feature == Feature::none) return d;
  PatchCache cache(scene.mesh());
  const FingerPose local{pose.position - scene.mesh().origin(), pose.orientation};
  IterationContext context{cache, preset.solver, preset.finger, local, scene.mesh().origin(), nullptr, 0};
  TrackedPlane at = plane;
  SurfaceSample s;
  sample_place(context, at, s);
  const PlaneContact c = contact_on_plane(preset.finger, context.pose, s.point, s.normal);
  const ContactJacobian jacobian = contact_jacobian(preset.finger, context.pose, s, c);
  for (int k = 0; k < 3; ++k) {
    Vec3 direction(0.0);
    direction[k] = 1.0;
    PlaneContact moved = c;
    moved.travel = direction - glm::dot(direction, s.normal) * s.normal;
    const ParameterStep step = newton_step(s, jacobian, moved);
    if (!step.valid) return d;
    d.contact_by_position[k] = step.da * s.point_u + step.db * s.point_v;
    d.normal_by_position[k] = step.da * s.normal_u + step.db * s.normal_v;
    // penetration = (S - p(N)).N with p(N) furthest along -N, so that dp.N = 0 for a turn of N, and (S - p) parallel N.
    d.penetration_by_position[k] = glm::dot(d.contact_by_position[k] - direction, s.normal);
  }
  d.valid = true;
  return d;
}

}  // namespace tangent
