// The steps of a bring-up that have force.
#include "workbench/bringup/bring_up.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr double kBefore_s = 0.4;  // the gate's ramp is over by then
constexpr double kRise_s = 0.5, kHold_s = 0.5, kFall_s = 0.25, kAfter_s = 0.5;
constexpr double kMeasured_s = 0.2;  // at the end of before, hold and after
constexpr double kSeen_m = 0.05e-3;  // least motion that counts,
constexpr double kOfNoise = 4.0, kOfStep = 3.0;
constexpr double kStop_n = 0.4;            // force that a stop is tried with
constexpr double kLongestSilence_s = 2.0;  // that a watchdog is waited for
constexpr double kRecover_s = 5.0, kByHandAgain_s = 120.0;

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

StopFacts& facts_of(BringUpFacts& facts, BringUpStep step) {
  return step == BringUpStep::stop ? facts.stop : step == BringUpStep::watchdog ? facts.watchdog : facts.emergency;
}

}  // namespace

// --- One push --------------------------------------------------------------------------------------------

bool BringUp::went_too_far() noexcept {
  if (phase_ == Phase::ask || phase_ == Phase::before || phase_ == Phase::judge) return false;
  return glm::length(sample_.position_m - before_.mean()) > level_n_ / kSoftest_n_per_m + kDrift_m;
}

void BringUp::start_push() noexcept {
  view_.ask = BringUpAsk::none;
  view_.again = BringUpWhy::none;
  before_.forget();
  held_.forget();
  after_.forget();
  cut_ = may_leave_ready_ = false;
  gate_.arm();
  enter(Phase::before);
}

bool BringUp::run_push() noexcept {
  const double t_s = in_phase_s();
  Vec3 full(0.0);
  full[view_.axis] = view_.force_n;
  switch (phase_) {
    case Phase::before:
      if (t_s > kBefore_s - kMeasured_s) before_.add(sample_.position_m);
      if (t_s >= kBefore_s) enter(Phase::rise);
      break;
    case Phase::rise:
      wanted_n_ = full * std::min(1.0, t_s / kRise_s);
      if (t_s >= kRise_s) enter(Phase::hold);
      break;
    case Phase::hold:
      wanted_n_ = full;
      if (t_s > kHold_s - kMeasured_s) held_.add(sample_.position_m);
      if (t_s < kHold_s) break;
      enter(Phase::fall);
      if (view_.step != BringUpStep::push) take_force_away();
      break;
    case Phase::fall:
      wanted_n_ = full * std::max(0.0, 1.0 - t_s / kFall_s);
      if (t_s >= kFall_s) enter(Phase::after);
      break;
    default:                                                                             // after
      if (cut_ && view_.step == BringUpStep::emergency && !has_none_) wanted_n_ = full;  // the device has to refuse it
      if (t_s > kAfter_s - kMeasured_s) after_.add(sample_.position_m);
      return t_s >= kAfter_s;
  }
  return false;
}

// --- Direction of the force ------------------------------------------------------------------------------

void BringUp::first_push() noexcept {
  view_.axis = 0;
  while (view_.axis < 3 && !can_.pushes_along[view_.axis]) ++view_.axis;
  level_n_ = std::min(options_.first_n, most_n_);
  view_.force_n = level_n_;
}

void BringUp::next_push() noexcept {
  tries_ = 0;
  if (view_.force_n > 0.0 && level_n_ < most_n_) {
    level_n_ = std::min(2.0 * level_n_, most_n_);
    view_.force_n = level_n_;
  } else if (view_.force_n > 0.0) {
    view_.force_n = -level_n_;  // at the limit the other way, too
  } else {
    do ++view_.axis;
    while (view_.axis < 3 && !can_.pushes_along[view_.axis]);
    if (view_.axis >= 3) return pass();
    view_.force_n = level_n_ = std::min(options_.first_n, most_n_);
  }
  enter(Phase::ask);
  ask(BringUpAsk::push);
}

void BringUp::push(BringUpAnswer said) noexcept {
  if (went_too_far()) {
    gate_.stop();
    enter(Phase::ask);
    return ask_again(BringUpAsk::push, BringUpWhy::push_too_far);
  }
  if (phase_ == Phase::ask) {
    if (level_n_ == 0.0) first_push();
    if (view_.axis >= 3 || most_n_ <= 0.0) return pass(StepVerdict::not_proved);
    if (!view_.asks()) return ask(BringUpAsk::push);
    if (said == BringUpAnswer::yes) return start_push();
    if (said == BringUpAnswer::no || said == BringUpAnswer::skip) fail(BringUpWhy::said_no);
  } else if (phase_ == Phase::judge) {
    if (said == BringUpAnswer::yes || said == BringUpAnswer::no) judge_push(said == BringUpAnswer::yes);
  } else if (run_push()) {
    gate_.stop();
    enter(Phase::judge);
    ask(BringUpAsk::moved);
  }
}

BringUp::Pushed BringUp::measured_push(PushFacts& push) const noexcept {
  push.axis = view_.axis;
  push.force_n = view_.force_n;
  push.moved_m = held_.mean() - 0.5 * (before_.mean() + after_.mean());  // without the drift of the hand
  push.seen_m = std::max({kSeen_m, kOfNoise * largest(view_.facts.rest.noise_m), kOfStep * can_.position_resolution_m,
                          largest(after_.mean() - before_.mean())});
  const double held_m = largest(held_.mean() - before_.mean()), left_m = largest(after_.mean() - before_.mean());
  if (left_m > 0.7 * held_m && left_m > 2.0 * kSeen_m + 2.0 * kOfStep * can_.position_resolution_m)
    return Pushed::stays;
  const double along = push.moved_m[view_.axis] * (view_.force_n > 0.0 ? 1.0 : -1.0);
  Vec3 others = push.moved_m;
  others[view_.axis] = 0.0;
  const double across = largest(others);
  if (along < -push.seen_m && -along >= across) return Pushed::reversed;
  if (across > push.seen_m && across > 2.0 * std::abs(along)) return Pushed::elsewhere;
  return along > push.seen_m && along >= across ? Pushed::right : Pushed::nowhere;
}

void BringUp::judge_push(bool said_right) noexcept {
  PushFacts push;
  const Pushed pushed = measured_push(push);
  push.measured_right = pushed == Pushed::right;
  push.said_right = said_right;
  BringUpFacts& facts = view_.facts;
  if (facts.push_count < BringUpFacts::kMostPushes) facts.pushes[facts.push_count++] = push;
  view_.ask = BringUpAsk::none;
  enter(Phase::ask);
  if (pushed == Pushed::right && said_right) return next_push();
  if (pushed == Pushed::stays) return ask_again(BringUpAsk::push, BringUpWhy::force_stays);
  const bool last = level_n_ >= most_n_;
  if (pushed == Pushed::nowhere && !last) return next_push();  // friction may hold a small force back
  if (pushed == Pushed::nowhere)
    return ask_again(BringUpAsk::push, said_right ? BringUpWhy::disagree : BringUpWhy::no_force);
  if (!said_right && pushed == Pushed::reversed) return fail(BringUpWhy::force_reversed);
  if (!said_right && pushed == Pushed::elsewhere) return fail(BringUpWhy::force_elsewhere);
  ask_again(BringUpAsk::push, BringUpWhy::disagree);
}

// --- Stops -----------------------------------------------------------------------------------------------

void BringUp::take_force_away() noexcept {
  cut_ = true;
  enter(Phase::after);
  cut_ticks_ = 0;
  if (view_.step == BringUpStep::stop) return gate_.stop();
  may_leave_ready_ = true;
  if (view_.step == BringUpStep::watchdog) return enter(Phase::silent);
  if (device_.emergency_stop()) return;
  gate_.stop();  // it has none
  has_none_ = true;
}

double BringUp::silence_s() const noexcept { return std::min(2.0 * can_.firmware_timeout_s + 0.05, kLongestSilence_s); }

// After a stop that the device made by itself it may have to find its zero again: nobody said yes to that yet.
void BringUp::recover(BringUpAnswer said) noexcept {
  may_leave_ready_ = true;
  const bool asks = view_.ask == BringUpAsk::home;
  if (asks && (said == BringUpAnswer::no || said == BringUpAnswer::skip)) return pass(StepVerdict::not_proved);
  if (asks && said != BringUpAnswer::yes) return;
  if (asks) {
    if (sample_.state == DeviceState::firmware) request_ = DeviceRequest::home;
    view_.ask = BringUpAsk::none;
    homes_again_ = true;
    recovers_from_s_ = view_.t_s;
    return;
  }
  const double most_s = !homes_again_ ? kRecover_s : can_.homing_s > 0.0 ? can_.homing_s + kRecover_s : kByHandAgain_s;
  if (view_.t_s - recovers_from_s_ > most_s) return pass(StepVerdict::not_proved);
  if (sample_.state == DeviceState::faulted) request_ = DeviceRequest::clear_fault;
  if (sample_.state == DeviceState::firmware && !homes_again_) ask(BringUpAsk::home);
}

void BringUp::try_stop(BringUpAnswer said) noexcept {
  if (phase_ == Phase::ask) {
    if (view_.step == BringUpStep::watchdog && can_.firmware_timeout_s <= 0.0) return pass(StepVerdict::not_proved);
    if (sample_.state != DeviceState::ready) return recover(said);
    if (view_.ask == BringUpAsk::home) view_.ask = BringUpAsk::none;  // it came back without it
    may_leave_ready_ = homes_again_ = false;
    first_push();
    if (view_.axis >= 3 || most_n_ <= 0.0) return pass(StepVerdict::not_proved);
    view_.force_n = level_n_ = std::min(kStop_n, most_n_);
    if (!view_.asks()) return ask(BringUpAsk::hold_on);
    if (said == BringUpAnswer::yes) return start_push();
    if (said == BringUpAnswer::no || said == BringUpAnswer::skip) pass(StepVerdict::not_proved);
    return;
  }
  recovers_from_s_ = view_.t_s;
  StopFacts& facts = facts_of(view_.facts, view_.step);
  if (phase_ == Phase::silent) {  // the first exchange after it: where is the handle now?
    facts.left_m = sample_.position_m[view_.axis] - before_.mean()[view_.axis];
    enter(Phase::after);
  }
  if (cut_ && (view_.sent_n != Vec3(0.0) || sample_.force_n != Vec3(0.0))) ++cut_ticks_;
  if (!cut_ && went_too_far()) {
    gate_.stop();
    enter(Phase::ask);
    return ask_again(BringUpAsk::hold_on, BringUpWhy::push_too_far);
  }
  if (run_push()) judge_stop(facts);
}

void BringUp::judge_stop(StopFacts& facts) noexcept {
  gate_.arm();  // forgives what the trial itself was: a silence, a device that is not ready any more
  gate_.stop();
  facts.force_n = view_.force_n;
  facts.held_m = held_.mean()[view_.axis] - before_.mean()[view_.axis];
  if (view_.step != BringUpStep::watchdog) facts.left_m = after_.mean()[view_.axis] - before_.mean()[view_.axis];
  facts.ticks_to_zero = cut_ticks_;
  if (std::exchange(has_none_, false)) return pass(StepVerdict::not_proved);
  if (std::abs(facts.left_m) < 0.5 * std::abs(facts.held_m)) return pass();
  enter(Phase::ask);
  ask_again(BringUpAsk::hold_on, BringUpWhy::force_stays);
}

}  // namespace tangent
