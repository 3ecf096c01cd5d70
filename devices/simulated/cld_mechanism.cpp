#include "devices/simulated/cld_mechanism.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

namespace {

double rounded(double v, double step) { return step > 0.0 ? std::round(v / step) * step : v; }

}  // namespace

// Compares the coefficients of (s^2 + sqrt(2) w s + w^2)(s + p), p = w / 8, with those of the closed loop's
// s^3 + (c + kd) s^2 + kp s + ki. The slow pole alone would cause a long overshoot after a step; the setpoint weight b
// places the closed loop's zero, -ki / (b kp), on that pole and cancels it.
CldGains gains_for(double bandwidth_hz, double drag_per_s) {
  const double w = 2.0 * std::numbers::pi * bandwidth_hz, p = w / 8.0, damping = std::numbers::sqrt2 * w;
  const double kp = w * w + damping * p, ki = w * w * p;
  return {.p_per_s2 = kp, .i_per_s3 = ki, .d_per_s = damping + p - drag_per_s, .target_weight = ki / (kp * p)};
}

CldMechanism::CldMechanism(const CldMechanismOptions& options)
    : options_(options), gains_(gains_for(options.bandwidth_hz, options.drag_per_s)) {}

double CldMechanism::encoder_m() const noexcept { return rounded(position_, options_.step_m); }

// At rest on the target the proportional part is -kp (1 - b) x and the integral balances it, so it is recomputed for
// the new gains.
void CldMechanism::set_gains(const CldGains& gains) noexcept {
  const auto held_up = [this] { return gains_.p_per_s2 * (1.0 - gains_.target_weight) * encoder_m(); };
  const double before = held_up();
  gains_ = gains.p_per_s2 > 0.0 ? gains : gains_for(options_.bandwidth_hz, options_.drag_per_s);
  integral_ += held_up() - before;
}

double CldMechanism::limited(double target_m) const noexcept {
  const double end = 0.5 * options_.travel_m;
  const double target =
      std::clamp(std::clamp(target_m, -end, end), std::max(limits_.lowest_m, -end), std::min(limits_.highest_m, end));
  if (limits_.fastest_m_per_s <= 0.0) return target;
  const double most = limits_.fastest_m_per_s * kPeriod_s;
  return std::clamp(target, target_ - most, target_ + most);
}

void CldMechanism::control(double target_m) noexcept { control(target_m, encoder_m()); }

void CldMechanism::control(double target_m, double reading_m) noexcept {
  target_ = limited(target_m);
  const double target = rounded(target_, options_.step_m);
  const double velocity = (reading_m - last_reading_) / kPeriod_s;
  last_reading_ = reading_m;
  const double wanted =
      gains_.p_per_s2 * (gains_.target_weight * target - reading_m) + integral_ - gains_.d_per_s * velocity;
  const double full = options_.full_acceleration_m_per_s2;
  const double most = limits_.largest_current_a > 0.0
                          ? full * std::min(1.0, limits_.largest_current_a / options_.full_current_a)
                          : full;
  const double got = std::clamp(wanted, -most, most);
  // Anti-windup: the integral is frozen while the current is at its limit.
  if (got == wanted) integral_ += gains_.i_per_s3 * (target - reading_m) * kPeriod_s;
  current_ = got / full;
  move(got);
}

void CldMechanism::hold() noexcept {
  velocity_ = current_ = 0.0;
  target_ = last_reading_ = encoder_m();
  // Bumpless restart: makes control resume from here without a jump.
  integral_ = gains_.p_per_s2 * (1.0 - gains_.target_weight) * last_reading_;
}

// Exact solution of x'' = b - c x' over one period T, with e = exp(-c T):
// v -> b/c + (v - b/c) e, x -> x + b/c T + (v - b/c) (1 - e) / c.
void CldMechanism::move(double acceleration) noexcept {
  const double c = options_.drag_per_s, decay = std::exp(-c * kPeriod_s);
  const double terminal = acceleration / c;
  position_ += terminal * kPeriod_s + (velocity_ - terminal) * (1.0 - decay) / c;
  velocity_ = terminal + (velocity_ - terminal) * decay;
  const double end = 0.5 * options_.travel_m;
  if (std::abs(position_) > end) {
    position_ = std::copysign(end, position_);
    velocity_ = 0.0;
  }
  const double slack = 0.5 * options_.backlash_m;
  roller_ = std::clamp(roller_, position_ - slack, position_ + slack);
}

}  // namespace tangent
