#include "workbench/bringup/guarded_exchange.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent {
namespace {

constexpr double kSilent_s = 0.1;         // without a new sample
constexpr std::uint32_t kMostBack = 3;    // samples older than the one before
constexpr double kFastest_m_per_s = 0.5;  // of the finger while there is force
constexpr double kOutside = 1.2, kOutside_m = 10e-3;

GateLimits tight_limits(const ForceCapabilities& can, double rate_hz, double most_n, double slew_n_per_s) {
  GateLimits limits;
  limits.period_s = 1.0 / rate_hz;
  limits.peak_force_n = most_n;
  limits.continuous_force_n = can.continuous_force_n > 0.0 ? std::min(can.continuous_force_n, most_n) : 0.0;
  limits.pushes_along = can.pushes_along;
  limits.workspace_half_size_m = can.workspace_half_size_m;
  limits.resolution_m = can.position_resolution_m;
  if (can.rate_hz > 0.0) limits.sample_s = std::min(1.0 / can.rate_hz, limits.stale_s);
  limits.slew_n_per_s = slew_n_per_s;
  limits.fastest_m_per_s = std::max(kFastest_m_per_s, 4.0 * can.position_resolution_m / limits.sample_s);
  return limits;
}

double most_force(const ForceCapabilities& can, double asked_n) {
  const double device_n = can.continuous_force_n > 0.0 ? can.continuous_force_n : can.peak_force_n;
  return std::max(0.0, std::min(asked_n, device_n));
}

}  // namespace

GuardedExchange::GuardedExchange(ForceDevice& device, double rate_hz, double most_n)
    : device_(device),
      can_(device.capabilities()),
      rate_hz_(rate_hz),
      most_n_(most_force(can_, most_n)),
      gate_(tight_limits(can_, rate_hz, most_n_, kSlew_n_per_s)) {}

void GuardedExchange::exchange(ExchangeView& view, double dt_s) noexcept {
  ForceCommand command;
  command.force_n = gate_.before_sending(dt_s);
  command.request = std::exchange(request_, DeviceRequest::none);
  view.sent_n = command.force_n;
  sample_ = device_.exchange(command, dt_s);
  view.device = sample_.state;
  view.device_fault = sample_.fault;
  if (sample_.state == DeviceState::ready) view.position_m = sample_.position_m;
}

BringUpWhy GuardedExchange::sample_problem(const ExchangeView& view, double dt_s) noexcept {
  const bool ready = sample_.state == DeviceState::ready;
  const bool left = was_ready_ && !ready && !may_leave_ready_;
  was_ready_ = was_ready_ || ready;
  if (left || (sample_.state == DeviceState::faulted && !may_leave_ready_)) return BringUpWhy::left_ready;
  if (!ready) return BringUpWhy::none;
  if (!is_finite(sample_.position_m) || !std::isfinite(sample_.age_s)) return BringUpWhy::not_finite;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = can_.workspace_half_size_m[axis];
    if (half > 0.0 && std::abs(sample_.position_m[axis]) > kOutside * half + kOutside_m) return BringUpWhy::outside;
  }
  // A tick that began late shows in the age: only what goes back by more than two periods does so by itself.
  const double measured_at_s = view.t_s - sample_.age_s;
  if (measured_at_s < measured_at_s_ - 2.0 / rate_hz_ - dt_s || sample_.age_s < 0.0) ++went_back_;
  measured_at_s_ = std::max(measured_at_s_, measured_at_s);
  if (went_back_ >= kMostBack) return BringUpWhy::backwards;
  if (sample_.age_s > kSilent_s && !may_be_silent_) return BringUpWhy::silent;
  const double rendered = glm::length(sample_.force_n), sent = glm::length(view.sent_n);
  const bool too_large = rendered > 1.2 * std::max(sent, glm::length(last_sent_n_)) + 0.05;
  return too_large ? BringUpWhy::force_too_large : BringUpWhy::none;
}

bool GuardedExchange::limit(ExchangeView& view, double dt_s, double declared_j, double stiffness_n_per_m) noexcept {
  GateInput input;
  input.force_n = wanted_n_;
  input.force_device = sample_.state;
  input.position_m = sample_.position_m;
  input.position_age_s = sample_.age_s;
  input.declared_j = declared_j;
  input.stiffness_n_per_m = stiffness_n_per_m;
  last_sent_n_ = view.sent_n;
  gate_.pass(input, dt_s);
  view.gate_fault = gate_.fault();
  return gate_.state() == GateState::faulted;
}

}  // namespace tangent
