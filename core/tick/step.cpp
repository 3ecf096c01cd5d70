#include "core/tick/step.h"

#include "core/base/float_state.h"
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

void keep_pose(const FingerPose& pose, double t_s, TickState& state) {
  state.last_position = pose.position;
  state.last_orientation = pose.orientation;
  state.last_t_s = t_s;
  state.has_previous = 1;
}

/// A tick, 3D or 2D: `find_contacts(planes, out)`, then force and display, then what the next tick's velocity needs.
template <class FindContacts>
void run_tick(const TickContext& tick, TickOutput& out, FindContacts find_contacts) {
  const FingerSection section = section_of(tick.pose.orientation);  // needed last, but has nothing to wait for
  TickPlanes planes;
  find_contacts(planes);
  const FingerWay way = finger_way(tick.pose.position, tick.t_s, tick.state);
  render_planes(tick.preset, planes, section, way, tick.velocity, tick.state.rendered, out);
  keep_pose(tick.pose, tick.t_s, tick.state);
}

/// A tick whose pose can't be used: what was rendered last is rendered on, where the finger was last.
void run_without_pose(const TickContext& tick, TickOutput& out) {
  const TickPlanes planes = TickPlanes::all(last_converged_plane(tick));
  const FingerWay way = finger_way(tick.pose.position, tick.t_s, tick.state);
  render_planes(tick.preset, planes, section_of(tick.pose.orientation), way, std::nullopt, tick.state.rendered, out);
  if (!tick.state.has_previous || !std::isfinite(tick.t_s)) return;
  tick.state.last_t_s = tick.t_s;  // time that a fade or a ramp has used is not used again
  tick.state.has_previous = kPoseIsOlder;
}

FingerPose last_pose(const TickState& state) { return {state.last_position, Quat(1.0, 0.0, 0.0, 0.0)}; }

}  // namespace

Stepper::Stepper(std::shared_ptr<const ContactScene> scene)
    : scene_(std::move(scene)), cache_(scene_->planar() ? nullptr : std::make_unique<StepCache>(scene_->mesh())) {}
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;
Stepper::~Stepper() = default;

TickOutput Stepper::step(const Preset& preset, const TickInput& input, TickState& state, IterationTrace* trace) {
  if (scene_->planar()) return step_planar(*scene_->planar(), preset, input, state, trace);
  const StepperUse use(cache_->in_use);
  if (!use.mine()) return {.status = TickStatus::busy};
  const FloatState as_tested;
  const bool usable = is_usable(input.finger);
  const FingerPose last = last_pose(state);
  const FingerPose& pose = usable ? input.finger : last;
  const Vec3& origin = scene_->mesh().origin();
  const FingerPose local{pose.position - origin, pose.orientation};
  const TickContext tick{preset, preset.finger, input.t_s, pose,           local,
                         origin, state,         trace,     input.velocity, input.all_at_once};
  TickOutput out;
  if (usable && input.unready) {
    run_tick(tick, out, [&](TickPlanes& planes) { planes = TickPlanes::all(last_converged_plane(tick)); });
  } else if (usable) {
    run_tick(tick, out, [&](TickPlanes& planes) { find_mesh_contacts(*scene_, *cache_, tick, planes, out); });
  } else {
    run_without_pose(tick, out);
  }
  return out;
}

TickOutput step_planar(const PlanarCurve& curve, const Preset& preset, const TickInput& input, TickState& state,
                       IterationTrace* trace) {
  const FloatState as_tested;
  const bool usable = is_usable(input.finger);
  const Finger finger = section_finger(preset.finger);
  const FingerPose pose = section_pose(usable ? input.finger : last_pose(state));
  const Vec3 origin = lifted(curve.origin());
  const FingerPose local{pose.position - origin, pose.orientation};
  const TickContext tick{preset, finger, input.t_s, pose, local, origin, state, trace, input.velocity};
  TickOutput out;
  out.normal = Vec3(0.0, 1.0, 0.0);  // where no contact is found
  if (usable) {
    run_tick(tick, out, [&](TickPlanes& planes) { find_planar_contacts(curve, tick, planes, out); });
  } else {
    run_without_pose(tick, out);
  }
  return out;
}

}  // namespace tangent
