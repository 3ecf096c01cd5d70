#include "devices/safety_gate.h"

#include <algorithm>
#include <cmath>

namespace tangent {

const char* to_string(GateState state) {
  switch (state) {
    case GateState::disarmed:
      return "disarmed";
    case GateState::ramping:
      return "ramping";
    case GateState::armed:
      return "armed";
    case GateState::faulted:
      return "faulted";
  }
  return "?";
}

const char* to_string(GateFault fault) {
  switch (fault) {
    case GateFault::none:
      return "none";
    case GateFault::force_not_finite:
      return "force not finite";
    case GateFault::display_not_finite:
      return "display target not finite";
    case GateFault::force_device:
      return "force device not ready";
    case GateFault::contact_display:
      return "contact display not ready";
    case GateFault::position_not_finite:
      return "position not finite";
    case GateFault::position_jumped:
      return "position jumped";
    case GateFault::position_frozen:
      return "position frozen";
    case GateFault::display_jumped:
      return "display jumped";
    case GateFault::display_frozen:
      return "display frozen";
    case GateFault::stale_sample:
      return "stale sample";
    case GateFault::late_tick:
      return "late tick";
    case GateFault::shaking:
      return "shaking";
  }
  return "?";
}

const char* to_string(GateAction action) {
  switch (action) {
    case GateAction::force_clamped:
      return "force clamped";
    case GateAction::slew_limited:
      return "slew limited";
    case GateAction::ramped_in:
      return "ramped in";
    case GateAction::display_clamped:
      return "display clamped";
    case GateAction::refused_not_finite:
      return "refused, not finite";
    case GateAction::withheld:
      return "withheld";
    case GateAction::workspace_faded:
      return "outside workspace";
    case GateAction::heat_clamped:
      return "clamped by heat";
    case GateAction::shake_reduced:
      return "shaking, reduced";
    case GateAction::ramped_out:
      return "ramped out";
    case GateAction::count_:
      break;
  }
  return "?";
}

namespace {

/// Scales `v` down to length `longest`; true when it was longer. Clamps the components first, so that squaring them
/// can't overflow.
bool shorten(Vec3& v, double longest) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool huge = largest > longest;
  if (huge) v *= longest / largest;
  const double length = std::sqrt(glm::dot(v, v));
  if (length > longest) {
    v *= longest / length;
    return true;
  }
  // A vector with one nonzero component is exactly at the limit now; any other was too long as well.
  return huge;
}

}  // namespace

void SafetyGate::forget_motion() noexcept {
  position_known_ = roller_known_ = false;
  frozen_.forget();
  display_frozen_.forget();
  shake_.forget();
}

void SafetyGate::arm() noexcept {
  state_ = GateState::ramping;
  fault_ = GateFault::none;
  since_armed_s_ = 0.0;
  force_was_ready_ = display_was_ready_ = falling_ = false;
  forget_motion();  // but not the thermal store: re-arming does not cool the motors
}

void SafetyGate::stop() noexcept {
  if (state_ != GateState::faulted) state_ = GateState::disarmed;
  falling_ = false;
}

void SafetyGate::restart_ramp() noexcept {
  if (!live()) return;
  state_ = GateState::ramping;
  since_armed_s_ = 0.0;
  forget_motion();
}

void SafetyGate::latch(GateFault fault) noexcept {
  if (state_ == GateState::faulted) return;
  state_ = GateState::faulted;
  fault_ = fault;
  ++faults_;
}

void SafetyGate::latch_falling(GateFault fault) noexcept {
  if (state_ == GateState::faulted) return;
  latch(fault);
  falling_ = true;
}

void SafetyGate::note(GateAction action, GateOutput& out) noexcept {
  out.actions = static_cast<GateActions>(out.actions | (1u << static_cast<unsigned>(action)));
  ++counts_[static_cast<std::size_t>(action)];
}

// --- Watching ------------------------------------------------------------------------------------------

/// Latches a fault on any value that is not finite, armed or not. False: the force is not finite.
bool SafetyGate::check_finite(const GateInput& input, GateOutput& out) noexcept {
  const bool force = is_finite(input.force_n), display = std::isfinite(input.display_m);
  const bool position = input.force_device != DeviceState::ready || is_finite(input.position_m);
  if (force && display && position) return true;
  note(GateAction::refused_not_finite, out);
  latch(!force     ? GateFault::force_not_finite
        : !display ? GateFault::display_not_finite
                   : GateFault::position_not_finite);
  falling_ = false;
  return force;
}

// A device that was ready since arming and leaves that state is a fault; one that is still homing is waited for.
void SafetyGate::watch_devices(const GateInput& input) noexcept {
  const auto failed = [](DeviceState state, bool& was_ready) {
    const bool ready = state == DeviceState::ready;
    const bool lost = (was_ready && !ready) || state == DeviceState::faulted;
    was_ready = was_ready || ready;
    return lost;
  };
  if (failed(input.force_device, force_was_ready_)) latch(GateFault::force_device);
  if (failed(input.display, display_was_ready_)) latch(GateFault::contact_display);
}

void SafetyGate::watch_freshness(const GateInput& input, double dt_s) noexcept {
  if (dt_s > limits_.late_s) latch_falling(GateFault::late_tick);
  const bool force_stale = input.force_device == DeviceState::ready && !(input.position_age_s <= limits_.stale_s);
  const bool display_stale = input.display == DeviceState::ready && !(input.display_age_s <= limits_.stale_s);
  if (force_stale || display_stale) latch_falling(GateFault::stale_sample);
}

void SafetyGate::watch_roller(const GateInput& input, double dt_s) noexcept {
  if (input.display != DeviceState::ready || !input.display_measures) {
    roller_known_ = false;
    display_frozen_.forget();
    return;
  }
  const double moved = input.display_measured_m - last_roller_m_;
  if (roller_known_ && !(std::abs(moved) <= limits_.fastest_display_m_per_s * dt_s)) latch(GateFault::display_jumped);
  if (display_frozen_.add(input.display_measured_m, last_display_m_)) latch(GateFault::display_frozen);
  last_roller_m_ = input.display_measured_m;
  roller_known_ = true;
}

void SafetyGate::watch_position(const GateInput& input, double dt_s) noexcept {
  if (input.force_device != DeviceState::ready) {
    position_known_ = false;
    frozen_.forget();
    shake_.forget();
    return;
  }
  if (position_known_) {
    const Vec3 moved = input.position_m - last_position_m_;
    if (glm::dot(moved, moved) > limits_.fastest_m_per_s * limits_.fastest_m_per_s * dt_s * dt_s) {
      latch(GateFault::position_jumped);
    }
    shake_.add(last_force_n_, moved, dt_s);
    if (shake_.stop()) latch(GateFault::shaking);
    if (frozen_.add(input.position_m)) latch(GateFault::position_frozen);
  }
  last_position_m_ = input.position_m;
  position_known_ = true;
}

// --- Limiting ------------------------------------------------------------------------------------------

double SafetyGate::workspace_share(const Vec3& position_m) const noexcept {
  double beyond = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = limits_.workspace_half_size_m[axis];
    if (half > 0.0) beyond = std::max(beyond, std::abs(position_m[axis] - workspace_centre_m_[axis]) - half);
  }
  if (beyond <= 0.0) return 1.0;
  return limits_.workspace_margin_m > 0.0 ? std::max(0.0, 1.0 - beyond / limits_.workspace_margin_m) : 0.0;
}

double SafetyGate::ramp_share(double dt_s) noexcept {
  if (state_ != GateState::ramping) return 1.0;
  const double share = limits_.ramp_s > 0.0 ? std::min(1.0, since_armed_s_ / limits_.ramp_s) : 1.0;
  since_armed_s_ += dt_s;
  if (share >= 1.0) state_ = GateState::armed;
  return share;
}

Vec3 SafetyGate::limit_force(const GateInput& input, double dt_s, GateOutput& out) noexcept {
  Vec3 force = input.force_n;
  if (shorten(force, limits_.peak_force_n)) note(GateAction::force_clamped, out);
  const auto reduce = [&](double share, GateAction action) {
    if (share >= 1.0) return;
    if (force != Vec3(0.0)) note(action, out);
    force *= share;
  };
  reduce(workspace_share(input.position_m), GateAction::workspace_faded);
  reduce(ramp_share(dt_s), GateAction::ramped_in);
  reduce(shake_.share(), GateAction::shake_reduced);
  if (shorten(force, budget_.allowed(limits_.peak_force_n, limits_.continuous_force_n))) {
    note(GateAction::heat_clamped, out);
  }
  Vec3 change = force - last_force_n_;
  if (shorten(change, limits_.slew_n_per_s * dt_s)) {
    force = last_force_n_ + change;
    note(GateAction::slew_limited, out);
  }
  return force;
}

// A stopped or faulted display holds its last target.
void SafetyGate::pass_display(const GateInput& input, GateOutput& out) noexcept {
  if (live()) {
    double end = 0.5 * limits_.display_travel_m;
    if (input.display_travel_m > 0.0) end = std::min(end, 0.5 * input.display_travel_m);
    const double target = std::clamp(input.display_m, std::clamp(input.display_lowest_m, -end, end),
                                     std::clamp(input.display_highest_m, -end, end));
    if (target != input.display_m && input.display != DeviceState::absent) note(GateAction::display_clamped, out);
    last_display_m_ = target;
  }
  out.display_m = last_display_m_;
}

GateOutput SafetyGate::pass(const GateInput& input, double dt_s) noexcept {
  GateOutput out;
  const bool force_finite = check_finite(input, out);
  if (live()) watch_devices(input);
  if (live()) watch_freshness(input, dt_s);
  if (live()) watch_roller(input, dt_s);
  if (live()) watch_position(input, dt_s);

  const bool device_ready = input.force_device == DeviceState::ready;
  if (live() && device_ready) {
    out.force_n = limit_force(input, dt_s, out);
  } else if (falling_ && device_ready) {
    // Half, then zero: no force within two ticks, without the jolt of dropping the full force at once.
    out.force_n = 0.5 * last_force_n_;
    if (out.force_n != Vec3(0.0)) note(GateAction::ramped_out, out);
    falling_ = false;
  } else if (force_finite && input.force_n != Vec3(0.0) && input.force_device != DeviceState::absent) {
    note(GateAction::withheld, out);
  }
  last_force_n_ = out.force_n;
  budget_.spend(std::sqrt(glm::dot(out.force_n, out.force_n)), limits_.peak_force_n, limits_.continuous_force_n, dt_s);
  pass_display(input, out);
  out.state = state_;
  out.fault = fault_;
  return out;
}

}  // namespace tangent
