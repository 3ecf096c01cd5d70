#include "devices/safety_gate.h"

#include "core/base/float_state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tangent {

namespace {

constexpr double kJustBelow = 1.0 - 4.0 * std::numeric_limits<double>::epsilon();

/// Scales `v` down to length `share * longest` when it is longer than `longest`, and says so. Clamps the components
/// first, so that squaring them can't overflow. A length is a sum and a root, each rounded: with kJustBelow it is never
/// above.
bool shorten(Vec3& v, double longest, double share = 1.0) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool huge = largest > longest;
  if (longest <= 0.0) {
    v = Vec3(0.0);
    return huge;
  }
  if (huge) v *= longest / largest;
  const double length = std::sqrt(glm::dot(v, v));
  if (length <= longest && !huge) return false;
  // A huge vector with one nonzero component is at the limit now; any other was too long as well.
  if (length > longest || share < 1.0) v *= share * (longest / std::max(length, longest));
  return true;
}

double length_of(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

}  // namespace

SafetyGate::SafetyGate(const GateLimits& limits) : limits_(check_limits(limits) ? limits : GateLimits{}) {}

void SafetyGate::forget_motion() noexcept {
  finger_.forget();
  roller_.forget();
  frozen_.forget();
  display_frozen_.forget();
  sent_.forget();
  energy_.forget();
  wall_ = {};
  declared_j_ = 0.0;
}

void SafetyGate::arm() noexcept {
  if (!live()) last_force_n_ = Vec3(0.0);
  state_ = GateState::ramping;
  fault_ = GateFault::none;
  since_armed_s_ = 0.0;
  force_was_ready_ = display_was_ready_ = falling_ = half_to_send_ = false;
  lateness_.forget();
  forget_motion();  // but not the thermal store: re-arming does not cool the motors
}

void SafetyGate::stop() noexcept {
  if (state_ != GateState::faulted) state_ = GateState::disarmed;
  falling_ = half_to_send_ = false;
}

void SafetyGate::stop_by(GateFault fault) noexcept {
  if (live()) latch(fault);
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

// --- Before sending ------------------------------------------------------------------------------------

// Zero at once after a stall, without the step at half force that pass takes: the device held the old force all along.
Vec3 SafetyGate::before_sending(double dt_s) noexcept {
  const FloatState as_tested;
  const bool late = !(dt_s <= longest_tick_s(limits_));
  if (late && std::isfinite(dt_s)) {  // the device held the old force all along
    spend_heat(dt_s);
    heat_is_spent_ = true;
  }
  const bool often = !late && lateness_.add(dt_s, limits_.period_s);
  if (late || often) stop_by(late ? GateFault::late_tick : GateFault::late_ticks);
  // A tick that is late but no fault: the force goes out only if its sample is not too old by now.
  const bool fresh = sample_age_s_ + dt_s <= limits_.stale_s + 1.5 * limits_.period_s;
  const bool may = (live() && fresh) || (half_to_send_ && !late);
  half_to_send_ = false;
  if (!may && last_force_n_ != Vec3(0.0)) {
    ++counts_[static_cast<std::size_t>(GateAction::withheld)];
    last_force_n_ = Vec3(0.0);
  }
  return last_force_n_;
}

void SafetyGate::spend_heat(double dt_s) noexcept {
  heat_.spend(length_of(last_force_n_), limits_.peak_force_n, limits_.continuous_force_n, dt_s);
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
  if (!(dt_s <= longest_tick_s(limits_))) latch_falling(GateFault::late_tick);
  const auto stale = [this](DeviceState state, double age_s) {
    return state == DeviceState::ready && !(age_s >= 0.0 && age_s <= limits_.stale_s);
  };
  if (stale(input.force_device, input.position_age_s) || stale(input.display, input.display_age_s))
    latch_falling(GateFault::stale_sample);
}

void SafetyGate::watch_roller(const GateInput& input, double dt_s) noexcept {
  if (input.display != DeviceState::ready || !input.display_measures) {
    roller_.forget();
    display_frozen_.forget();
    return;
  }
  const MotionStep step = roller_.add(Vec3(input.display_measured_m, 0.0, 0.0), input.display_age_s, dt_s,
                                      {limits_.fastest_display_m_per_s, limits_.display_sample_s});
  if (step.leapt) latch(GateFault::display_jumped);
  if (step.counted && display_frozen_.add(input.display_measured_m, last_display_m_)) latch(GateFault::display_frozen);
}

void SafetyGate::watch_position(const GateInput& input, double dt_s) noexcept {
  if (input.force_device != DeviceState::ready) {
    forget_motion();
    return;
  }
  const MotionStep step =
      finger_.add(input.position_m, input.position_age_s, dt_s, {limits_.fastest_m_per_s, limits_.sample_s});
  if (step.leapt) return latch(GateFault::position_jumped);
  if (step.counted && frozen_.add(input.position_m)) latch(GateFault::position_frozen);
  watch_energy(input, step, dt_s);
}

void SafetyGate::watch_energy(const GateInput& input, const MotionStep& step, double dt_s) noexcept {
  sent_.add(last_force_n_, dt_s);
  EnergyWatch::Step work;
  work.dt_s = dt_s;
  work.hold_s = limits_.period_s + 2.0 * input.position_age_s;
  work.resolution_m = limits_.resolution_m;
  work.declared_j = std::exchange(declared_j_, 0.0);
  work.wall = wall_;
  if (step.fresh && step.moved_m != Vec3(0.0)) {
    work.moved_m = step.moved_m;
    work.force_n = sent_.mean(step.from_s, step.to_s);
    work.hold_s += std::max(0.0, step.to_s - step.from_s - limits_.period_s);
  }
  if (energy_.add(work)) latch(GateFault::shaking);
}

// --- Limiting ------------------------------------------------------------------------------------------

double SafetyGate::workspace_share(const Vec3& position_m) const noexcept {
  double beyond = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = limits_.workspace_half_size_m[axis];
    if (half > 0.0) beyond = std::max(beyond, std::abs(position_m[axis]) - half);
  }
  if (beyond <= 0.0) return 1.0;
  return limits_.workspace_margin_m > 0.0 ? std::max(0.0, 1.0 - beyond / limits_.workspace_margin_m) : 0.0;
}

double SafetyGate::ramp_share(double dt_s) noexcept {
  if (state_ != GateState::ramping) return 1.0;
  const double share = limits_.ramp_s > 0.0 ? std::min(1.0, since_armed_s_ / limits_.ramp_s) : 1.0;
  since_armed_s_ += std::min(dt_s, limits_.period_s);
  if (share >= 1.0) state_ = GateState::armed;
  return share;
}

// What the gate itself gives back, as its ramp or the edge of the workspace, is declared: the hand did not pay for it.
void SafetyGate::note_wall(const GateInput& input, double share, double limit_n) noexcept {
  RenderedWall now{input.stiffness_n_per_m, std::max(length_of(input.force_n), input.elastic_n), limit_n, share};
  if (!(std::isfinite(now.stiffness_n_per_m) && now.stiffness_n_per_m > 0.0)) now.stiffness_n_per_m = 0.0;
  if (!std::isfinite(now.asked_n)) now.asked_n = limits_.peak_force_n;
  RenderedWall before = now;
  before.share = wall_.share;
  before.limit_n = wall_.limit_n;
  declared_j_ += std::max(0.0, stored_energy(now) - stored_energy(before));
  if (input.declared_j > 0.0) declared_j_ += std::min(input.declared_j, stored_energy(now) + EnergyWatch::kMargin_j);
  wall_ = now;
}

Vec3 SafetyGate::limit_force(const GateInput& input, double dt_s, GateOutput& out) noexcept {
  Vec3 force = input.force_n;
  for (int axis = 0; axis < 3; ++axis)
    if (!limits_.pushes_along[static_cast<std::size_t>(axis)]) force[axis] = 0.0;
  if (shorten(force, limits_.peak_force_n, kJustBelow)) note(GateAction::force_clamped, out);
  const auto reduce = [&](double share, GateAction action) {
    if (share >= 1.0) return;
    if (force != Vec3(0.0)) note(action, out);
    force *= share;
  };
  const double in_workspace = workspace_share(input.position_m), ramped = ramp_share(dt_s);
  reduce(in_workspace, GateAction::workspace_faded);
  reduce(ramped, GateAction::ramped_in);
  const double allowed_n = heat_.allowed(limits_.peak_force_n, limits_.continuous_force_n);
  note_wall(input, in_workspace * ramped, allowed_n);
  if (shorten(force, allowed_n)) note(GateAction::heat_clamped, out);
  Vec3 change = force - last_force_n_;
  if (shorten(change, limits_.slew_n_per_s * std::min(dt_s, limits_.period_s))) {
    force = last_force_n_ + change;
    note(GateAction::slew_limited, out);
  }
  shorten(force, limits_.peak_force_n, kJustBelow);  // the sum was rounded
  return force;
}

// A stopped or faulted display holds its last target.
void SafetyGate::pass_display(const GateInput& input, double dt_s, GateOutput& out) noexcept {
  out.display_m = last_display_m_;
  if (!live()) return;
  double end = 0.5 * limits_.display_travel_m;
  if (input.display_travel_m > 0.0) end = std::min(end, 0.5 * input.display_travel_m);
  const double target = std::clamp(input.display_m, std::clamp(input.display_lowest_m, -end, end),
                                   std::clamp(input.display_highest_m, -end, end));
  if (target != input.display_m && input.display != DeviceState::absent) note(GateAction::display_clamped, out);
  double fastest = limits_.fastest_target_m_per_s;
  if (input.display_fastest_m_per_s > 0.0) fastest = std::min(fastest, input.display_fastest_m_per_s);
  const double most = fastest * std::min(dt_s, limits_.period_s);
  out.display_m = std::clamp(target, last_display_m_ - most, last_display_m_ + most);
  if (out.display_m != target && input.display != DeviceState::absent) note(GateAction::display_slowed, out);
  last_display_m_ = out.display_m;
}

GateOutput SafetyGate::pass(const GateInput& input, double dt_s) noexcept {
  const FloatState as_tested;
  GateOutput out;
  const bool force_finite = check_finite(input, out);
  if (live()) watch_devices(input);
  if (live()) watch_freshness(input, dt_s);
  if (live()) watch_roller(input, dt_s);
  if (live()) watch_position(input, dt_s);

  const bool device_ready = input.force_device == DeviceState::ready;
  half_to_send_ = false;
  if (live() && device_ready) {
    out.force_n = limit_force(input, dt_s, out);
  } else if (falling_ && device_ready) {
    // Half, then zero: no force within two ticks, without the jolt of dropping the full force at once.
    out.force_n = 0.5 * last_force_n_;
    if (out.force_n != Vec3(0.0)) note(GateAction::ramped_out, out);
    falling_ = false;
    half_to_send_ = true;
  } else if (force_finite && input.force_n != Vec3(0.0) && input.force_device != DeviceState::absent) {
    note(GateAction::withheld, out);
  }
  last_force_n_ = out.force_n;
  sample_age_s_ = input.position_age_s;
  if (!std::exchange(heat_is_spent_, false)) spend_heat(dt_s);
  pass_display(input, dt_s, out);
  out.state = state_;
  out.fault = fault_;
  return out;
}

}  // namespace tangent
