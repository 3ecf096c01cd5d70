#include "workbench/bringup/bring_up.h"

#include "workbench/bringup/axis_check.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr double kAnswer_s = 10.0;   // for the device to answer, and to say what it is
constexpr double kByHand_s = 120.0;  // to home it by hand
constexpr double kSpare_s = 2.0;     // beyond the time that it says homing takes
constexpr double kSettle_s = 0.3;    // after a handle was let go
constexpr double kRest_s = 1.0;      // of measuring at rest,
constexpr double kRate_s = 1.0;      // and of the rate
constexpr double kNoisy_m = 0.1e-3;  // RMS at rest, where steps are finer
constexpr double kWander_m = 2e-3;   // at rest
constexpr double kSlow = 0.95;       // of the rate that it is designed for
constexpr double kMostLost = 0.01;   // of the samples
constexpr double kCoarse = 3.0;      // times the resolution that it says
constexpr double kShortMove_m = 0.05;

/// Far enough to be judged, and within the workspace.
double move_length(const ForceCapabilities& can) {
  double length = kShortMove_m;
  for (int axis = 0; axis < 3; ++axis)
    if (can.workspace_half_size_m[axis] > 0.0) length = std::min(length, 0.6 * can.workspace_half_size_m[axis]);
  return std::max(length, 10e-3);
}

}  // namespace

bool BringUpView::all_proved() const {
  constexpr std::size_t kMaybeMissing = static_cast<std::size_t>(BringUpStep::watchdog);
  for (std::size_t i = 0; i < kBringUpSteps; ++i)
    if (verdicts[i] != StepVerdict::proved && !(i >= kMaybeMissing && verdicts[i] == StepVerdict::not_proved))
      return false;
  return true;
}

BringUp::BringUp(ForceDevice& device, const BringUpOptions& options)
    : GuardedExchange(device, options.rate_hz, options.most_n), options_(options) {
  view_.verdicts.front() = StepVerdict::running;
  view_.move_m = move_length(can_);
}

// --- Every tick ------------------------------------------------------------------------------------------

void BringUp::tick(double dt_s) noexcept {
  view_.t_s += dt_s;
  unsent_s_ += dt_s;
  wanted_n_ = Vec3(0.0);
  const bool silent = phase_ == Phase::silent && has_force() && in_phase_s() < silence_s();
  if (silent && !stop_.load(std::memory_order_relaxed)) return;
  const double since_s = std::exchange(unsent_s_, 0.0);
  exchange(view_, since_s);
  const BringUpAnswer said = take_answer();
  if (stop_.load(std::memory_order_relaxed) && !view_.ended) fail(BringUpWhy::stopped);
  if (!view_.ended) {
    may_be_silent_ = cut_;
    if (const BringUpWhy why = sample_problem(view_, since_s); why != BringUpWhy::none) fail(why);
  }
  if (!view_.ended) {
    switch (view_.step) {
      case BringUpStep::cable:
      case BringUpStep::permission:
      case BringUpStep::firmware:
        wait_for_device();
        break;
      case BringUpStep::homing:
        home(said);
        break;
      case BringUpStep::still:
        rest(said);
        break;
      case BringUpStep::axes:
        move(said);
        break;
      case BringUpStep::rate:
        measure_rate(since_s);
        break;
      case BringUpStep::push:
        push(said);
        break;
      default:
        try_stop(said);
    }
  }
  if (view_.ended || !has_force()) gate_.stop();
  // Work that a push does on the softest hand that holds, as it grows.
  const double declared_j = glm::length(wanted_n_) * kSlew_n_per_s * since_s / kSoftest_n_per_m;
  if (limit(view_, since_s, declared_j) && !view_.ended && !cut_) fail(BringUpWhy::gate_stopped);
  view_.sent_n = view_.ended ? Vec3(0.0) : view_.sent_n;
}

BringUpAnswer BringUp::take_answer() noexcept {
  const std::uint64_t said = answer_.exchange(0, std::memory_order_relaxed);
  const bool to_this = view_.asks() && static_cast<std::uint32_t>(said >> 8) == view_.questions;
  return to_this ? static_cast<BringUpAnswer>(said & 0xff) : BringUpAnswer::none;
}

// --- From step to step -----------------------------------------------------------------------------------

void BringUp::begin(BringUpStep step) noexcept {
  if (step == BringUpStep::count_) {
    view_.ended = true;
    view_.ask = BringUpAsk::none;
    return;
  }
  view_.step = step;
  view_.verdicts[static_cast<std::size_t>(step)] = StepVerdict::running;
  view_.ask = BringUpAsk::none;
  view_.again = BringUpWhy::none;
  view_.axis = 0;
  step_began_s_ = recovers_from_s_ = view_.t_s;
  tries_ = 0;
  cut_ = homes_again_ = false;
  enter(Phase::ask);
  mean_.forget();
}

void BringUp::pass(StepVerdict verdict) noexcept {
  view_.verdicts[static_cast<std::size_t>(view_.step)] = verdict;
  begin(static_cast<BringUpStep>(static_cast<std::uint8_t>(view_.step) + 1));
}

void BringUp::fail(BringUpWhy why) noexcept {
  gate_.stop();
  wanted_n_ = Vec3(0.0);
  view_.end_with(why);
}

void BringUp::ask(BringUpAsk what, BringUpWhy again) noexcept {
  view_.ask = what;
  view_.again = again;
  ++view_.questions;
}

void BringUp::ask_again(BringUpAsk what, BringUpWhy why) noexcept {
  if (++tries_ >= kTries) return fail(why);
  ask(what, why);
}

void BringUp::enter(Phase phase) noexcept {
  phase_ = phase;
  phase_began_s_ = view_.t_s;
}

// --- Without force ---------------------------------------------------------------------------------------

void BringUp::wait_for_device() noexcept {
  const bool opened = sample_.state != DeviceState::absent;
  const bool known = opened && sample_.state != DeviceState::open;
  const bool done = view_.step == BringUpStep::firmware ? known : opened;
  if (done) return pass();
  if (in_step_s() > kAnswer_s) fail(opened ? BringUpWhy::no_firmware : BringUpWhy::not_attached);
}

void BringUp::home(BringUpAnswer said) noexcept {
  if (sample_.state == DeviceState::ready) return pass();
  if (said_home_) {
    const double most_s = can_.homing_s > 0.0 ? can_.homing_s + kSpare_s : kByHand_s;
    if (in_phase_s() > most_s) fail(BringUpWhy::not_homed);
    return;
  }
  if (!view_.asks()) return ask(BringUpAsk::home);
  if (said == BringUpAnswer::no || said == BringUpAnswer::skip) return fail(BringUpWhy::said_no);
  if (said != BringUpAnswer::yes) return;
  if (sample_.state == DeviceState::firmware) request_ = DeviceRequest::home;
  said_home_ = true;
  view_.ask = BringUpAsk::none;
  enter(Phase::before);
}

void BringUp::rest(BringUpAnswer said) noexcept {
  if (phase_ == Phase::ask) {
    if (!view_.asks()) return ask(BringUpAsk::let_go);
    if (said == BringUpAnswer::no || said == BringUpAnswer::skip) return pass(StepVerdict::not_proved);
    if (said != BringUpAnswer::yes) return;
    view_.ask = BringUpAsk::none;
    mean_.forget();
    return enter(Phase::before);
  }
  if (in_phase_s() < kSettle_s) return;
  mean_.add(sample_.position_m);
  if (in_phase_s() < kSettle_s + kRest_s) return;
  view_.facts.rest = {in_phase_s() - kSettle_s, mean_.rms(), mean_.range(), mean_.count()};
  const Vec3 noise = mean_.rms();
  const double worst = std::max({noise.x, noise.y, noise.z});
  if (worst <= std::max(kNoisy_m, can_.position_resolution_m) && mean_.range() <= kWander_m) return pass();
  enter(Phase::ask);
  ask_again(BringUpAsk::let_go, BringUpWhy::noisy);
}

void BringUp::move(BringUpAnswer said) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const double step = std::abs(sample_.position_m[axis] - last_m_[axis]);
    double& least = view_.facts.smallest_step_m;
    if (in_step_s() > 0.0 && step > 0.0 && (least == 0.0 || step < least)) least = step;
  }
  last_m_ = sample_.position_m;
  if (!view_.asks()) return ask(BringUpAsk::take);
  if (said == BringUpAnswer::none) return;
  if (view_.ask == BringUpAsk::take) {
    if (said != BringUpAnswer::yes) return fail(BringUpWhy::said_no);
    from_m_ = sample_.position_m;
    return ask(BringUpAsk::move);
  }
  MotionFacts& motion = view_.facts.motions[view_.axis];
  if (said == BringUpAnswer::skip || said == BringUpAnswer::no) {
    motion = {{}, StepVerdict::not_proved, BringUpWhy::said_no};
    from_m_ = sample_.position_m;
  } else {
    motion.moved_m = sample_.position_m - from_m_;
    from_m_ = sample_.position_m;
    judge_motion();
    if (motion.verdict == StepVerdict::waiting) return;
  }
  tries_ = 0;
  if (++view_.axis < 3) return ask(BringUpAsk::move);
  judge_axes();
}

void BringUp::judge_motion() noexcept {
  MotionFacts& motion = view_.facts.motions[view_.axis];
  motion.why = motion_problem(motion.moved_m, view_.move_m);
  if (motion.why != BringUpWhy::none) {
    if (++tries_ < kTries) return ask(BringUpAsk::take, motion.why);
    motion.verdict = StepVerdict::failed;
    if (motion.why == BringUpWhy::moved_too_little) motion.why = BringUpWhy::axis_dead;
    return;
  }
  const Vec3 in_world = turned(can_.frame.rotation, motion.moved_m);
  const int which = signed_axis(in_world);
  const Vec3 wanted = asked_direction(view_.axis);
  const bool right = which != 0 && wanted[std::abs(which) - 1] * which > 0.0;
  motion.verdict = right ? StepVerdict::proved : StepVerdict::failed;
  if (!right) motion.why = BringUpWhy::axis_wrong;
}

// The worst decides: a dead axis hides what another one reads.
void BringUp::judge_axes() noexcept {
  bool skipped = false, any = false;
  for (const MotionFacts& motion : view_.facts.motions) {
    if (motion.verdict == StepVerdict::failed) return fail(motion.why);
    skipped = skipped || motion.verdict == StepVerdict::not_proved;
    any = any || motion.verdict == StepVerdict::proved;
  }
  if (!any) return fail(BringUpWhy::said_no);
  const double claimed = can_.position_resolution_m;
  if (claimed > 0.0 && view_.facts.smallest_step_m > kCoarse * claimed) return fail(BringUpWhy::step_coarse);
  bool all_pushed = true;  // of an axis that isn't pushed a motion may be missing
  for (const bool pushes : can_.pushes_along) all_pushed = all_pushed && pushes;
  pass(skipped && all_pushed ? StepVerdict::not_proved : StepVerdict::proved);
}

void BringUp::measure_rate(double dt_s) noexcept {
  RateFacts& rate = view_.facts.rate;
  const double period_s = 1.0 / options_.rate_hz;
  const double sample_s = can_.rate_hz > 0.0 ? std::max(period_s, 1.0 / can_.rate_hz) : period_s;
  ++rate.ticks;
  if (dt_s > 1.5 * period_s) ++rate.late;
  if (sample_.age_s > 1.5 * sample_s) ++rate.lost;
  rate.oldest_s = std::max(rate.oldest_s, sample_.age_s);
  rate.mean_age_s += (sample_.age_s - rate.mean_age_s) / rate.ticks;
  if (in_step_s() < kRate_s) return;
  rate.hz = rate.ticks / in_step_s();
  if (rate.oldest_s > gate_.limits().stale_s) return fail(BringUpWhy::old_samples);
  if (rate.lost > kMostLost * rate.ticks) return fail(BringUpWhy::lost_samples);
  const double wanted = can_.rate_hz > 0.0 ? std::min(can_.rate_hz, options_.rate_hz) : options_.rate_hz;
  if (rate.hz < kSlow * wanted) return fail(BringUpWhy::slow);
  pass();
}

}  // namespace tangent
