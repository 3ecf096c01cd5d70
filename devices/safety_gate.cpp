#include "devices/safety_gate.h"

#include <algorithm>
#include <cmath>

namespace tangent {

const char* to_string(GateState state) {
  switch (state) {
    case GateState::disarmed: return "disarmed";
    case GateState::ramping: return "ramping";
    case GateState::armed: return "armed";
    case GateState::faulted: return "faulted";
  }
  return "?";
}

const char* to_string(GateFault fault) {
  switch (fault) {
    case GateFault::none: return "none";
    case GateFault::force_not_finite: return "force not finite";
    case GateFault::display_not_finite: return "display target not finite";
    case GateFault::force_device: return "force device not ready";
    case GateFault::contact_display: return "contact display not ready";
  }
  return "?";
}

const char* to_string(GateAction action) {
  switch (action) {
    case GateAction::force_clamped: return "force clamped";
    case GateAction::slew_limited: return "slew limited";
    case GateAction::ramped_in: return "ramped in";
    case GateAction::display_clamped: return "display clamped";
    case GateAction::refused_not_finite: return "refused, not finite";
    case GateAction::withheld: return "withheld";
    case GateAction::count_: break;
  }
  return "?";
}

namespace {

/// `v` shortened to `longest`; true when it was longer. Components are brought into range first, so that
/// squaring them can't overflow.
bool shorten(Vec3& v, double longest) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool huge = largest > longest;
  if (huge) v *= longest / largest;
  const double length = std::sqrt(glm::dot(v, v));
  if (length > longest) {
    v *= longest / length;
    return true;
  }
  // A vector of one component is exactly at the limit now; every other one was longer still.
  return huge;
}

}  // namespace

void SafetyGate::arm() noexcept {
  state_ = GateState::ramping;
  fault_ = GateFault::none;
  since_armed_s_ = 0.0;
  force_was_ready_ = display_was_ready_ = false;
}

void SafetyGate::stop() noexcept {
  if (state_ != GateState::faulted) state_ = GateState::disarmed;
}

void SafetyGate::restart_ramp() noexcept {
  if (state_ != GateState::armed && state_ != GateState::ramping) return;
  state_ = GateState::ramping;
  since_armed_s_ = 0.0;
}

void SafetyGate::latch(GateFault fault) noexcept {
  if (state_ == GateState::faulted) return;
  state_ = GateState::faulted;
  fault_ = fault;
  ++faults_;
}

void SafetyGate::note(GateAction action, GateOutput& out) noexcept {
  out.actions = static_cast<std::uint8_t>(out.actions | (1u << static_cast<unsigned>(action)));
  ++counts_[static_cast<std::size_t>(action)];
}

// A device that has been ready since arming may not leave that state unnoticed; one that is still homing is
// waited for.
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

Vec3 SafetyGate::limit_force(const Vec3& wanted, double dt_s, GateOutput& out) noexcept {
  Vec3 force = wanted;
  if (shorten(force, limits_.peak_force_n)) note(GateAction::force_clamped, out);
  if (state_ == GateState::ramping) {
    const double share = limits_.ramp_s > 0.0 ? std::min(1.0, since_armed_s_ / limits_.ramp_s) : 1.0;
    since_armed_s_ += dt_s;
    if (share >= 1.0) state_ = GateState::armed;
    else if (force != Vec3(0.0)) note(GateAction::ramped_in, out);
    force *= share;
  }
  Vec3 change = force - last_force_n_;
  if (shorten(change, limits_.slew_n_per_s * dt_s)) {
    force = last_force_n_ + change;
    note(GateAction::slew_limited, out);
  }
  return force;
}

GateOutput SafetyGate::pass(const GateInput& input, double dt_s) noexcept {
  GateOutput out;
  if (state_ == GateState::ramping || state_ == GateState::armed) watch_devices(input);
  const bool force_finite = is_finite(input.force_n), display_finite = std::isfinite(input.display_m);
  if (!force_finite || !display_finite) {
    note(GateAction::refused_not_finite, out);
    latch(force_finite ? GateFault::display_not_finite : GateFault::force_not_finite);
  }

  const bool live = state_ == GateState::ramping || state_ == GateState::armed;
  if (live && input.force_device == DeviceState::ready) {
    out.force_n = limit_force(input.force_n, dt_s, out);
  } else if (force_finite && input.force_n != Vec3(0.0) && input.force_device != DeviceState::absent) {
    note(GateAction::withheld, out);
  }
  last_force_n_ = out.force_n;

  // A stopped or faulted display holds still where it was last sent.
  if (live) {
    const double end = 0.5 * limits_.display_travel_m;
    const double target = std::clamp(input.display_m, -end, end);
    if (target != input.display_m && input.display != DeviceState::absent) note(GateAction::display_clamped, out);
    last_display_m_ = target;
  }
  out.display_m = last_display_m_;
  out.state = state_;
  out.fault = fault_;
  return out;
}

}  // namespace tangent
