#include "core/tick/step.h"

#include "core/tick/mesh_contacts.h"
#include "core/tick/planar_contacts.h"
#include "core/tick/rendering.h"

#include <cmath>

namespace tangent {
namespace {

/// Finite, and so far from overflow that squares are: one number that isn't spoils the sum.
bool is_usable(const FingerPose& pose) {
  return std::isfinite(glm::dot(pose.position, pose.position) + glm::dot(pose.orientation, pose.orientation));
}

/// The pose itself, or the last one where it can't be used.
FingerPose usable_pose(const FingerPose& pose, const TickState& state) {
  return is_usable(pose) ? pose : FingerPose{state.last_position, Quat(1.0, 0.0, 0.0, 0.0)};
}

/// A pose that is not finite: what was rendered last, where the finger was last.
TickPlanes planes_without_pose(const TickContext& tick) {
  const RenderPlane last = last_converged_plane(tick);
  return {last, last, last, last, last};
}

void keep_pose(const Vec3& position, double t_s, TickState& state) {
  state.last_position = position;
  state.last_t_s = t_s;
  state.has_previous = 1;
}

/// A tick, 3D or 2D: `find_contacts(planes, out)`, then force and display, then what the next tick's velocity needs.
/// `pose`: of the finger, world; `out`: as it is where no contact is found.
template <class FindContacts>
TickOutput run_tick(const TickContext& tick, const FingerPose& pose, bool usable, TickOutput out,
                    FindContacts find_contacts) {
  if (!usable) {
    render_planes(tick.preset, planes_without_pose(tick), pose, Vec3(0.0), out);
    return out;
  }
  TickPlanes planes;
  find_contacts(planes, out);
  const Vec3 velocity = finger_velocity(tick.preset, pose.position, tick.t_s, tick.state);
  render_planes(tick.preset, planes, pose, velocity, out);
  keep_pose(pose.position, tick.t_s, tick.state);
  return out;
}

}  // namespace

Stepper::Stepper(std::shared_ptr<const ContactScene> scene)
    : scene_(std::move(scene)), cache_(std::make_unique<StepCache>(scene_->mesh())) {}
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;
Stepper::~Stepper() = default;

TickOutput Stepper::step(const Preset& preset, const TickInput& input, TickState& state, IterationTrace* trace) {
  if (scene_->planar()) return step_planar(*scene_->planar(), preset, input, state, trace);
  const FingerPose pose = usable_pose(input.finger, state);
  const Vec3 origin = scene_->mesh().origin();
  const FingerPose local{pose.position - origin, pose.orientation};
  const TickContext tick{preset, preset.finger, input.t_s, local, origin, state, trace};
  return run_tick(tick, pose, is_usable(input.finger), TickOutput{}, [&](TickPlanes& planes, TickOutput& out) {
    find_mesh_contacts(*scene_, *cache_, tick, planes, out);
  });
}

TickOutput step_planar(const PlanarCurve& curve, const Preset& preset, const TickInput& input, TickState& state,
                       IterationTrace* trace) {
  const Finger finger = section_finger(preset.finger);
  const FingerPose pose = section_pose(usable_pose(input.finger, state));
  const Vec3 origin = lifted(curve.origin());
  const FingerPose local{pose.position - origin, pose.orientation};
  const TickContext tick{preset, finger, input.t_s, local, origin, state, trace};
  TickOutput nothing;
  nothing.normal = Vec3(0.0, 1.0, 0.0);
  return run_tick(tick, pose, is_usable(input.finger), nothing,
                  [&](TickPlanes& planes, TickOutput& out) { find_planar_contacts(curve, tick, planes, out); });
}

}  // namespace tangent
