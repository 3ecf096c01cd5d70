#include "workbench/bringup/force_calibration.h"

#include "workbench/bringup/bring_up_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace tangent {
namespace {

constexpr double kAttach_s = 10.0, kIdentify_s = 10.0;
constexpr double kHomed_s = 120.0;  // by hand
constexpr double kArm_s = 0.4;      // the gate's ramp is over by then
constexpr double kPullRise_s = 0.5, kPullFall_s = 0.25;
constexpr double kSteady_s = 0.5;         // before it is asked for the reading
constexpr double kOfAsked = 0.9;          // that has to be rendered
constexpr double kSpring_n_per_m = 15.0;  // a spring scale is no softer
constexpr double kUnit_n = 1e-4;          // of a reading on its way
constexpr std::uint64_t kMostUnits = 0xffffff;

}  // namespace

ForceCalibration::ForceCalibration(ForceDevice& device, const CalibrationOptions& options)
    : GuardedExchange(device, options.rate_hz, kMostAsked_n) {}

// --- Every tick ------------------------------------------------------------------------------------------

void ForceCalibration::answer(const CalibrationAnswer& answer, std::uint32_t question) noexcept {
  const double units = std::isfinite(answer.read_n) ? std::round(answer.read_n / kUnit_n) : 0.0;
  const auto read = static_cast<std::uint64_t>(std::clamp(units, 0.0, static_cast<double>(kMostUnits)));
  answer_.store(std::uint64_t{question} << 32 | read << 8 | static_cast<std::uint64_t>(answer.said),
                std::memory_order_relaxed);
}

CalibrationAnswer ForceCalibration::take_answer() noexcept {
  const std::uint64_t said = answer_.exchange(0, std::memory_order_relaxed);
  if (!view_.asks() || static_cast<std::uint32_t>(said >> 32) != view_.questions) return {};
  return {static_cast<BringUpAnswer>(said & 0xff), static_cast<double>(said >> 8 & kMostUnits) * kUnit_n};
}

void ForceCalibration::tick(double dt_s) noexcept {
  view_.t_s += dt_s;
  wanted_n_ = Vec3(0.0);
  exchange(view_, dt_s);
  const CalibrationAnswer said = take_answer();
  if (stop_.load(std::memory_order_relaxed) && !view_.ended) fail(BringUpWhy::stopped);
  if (!view_.ended) {
    if (const BringUpWhy why = sample_problem(view_, dt_s); why != BringUpWhy::none) fail(why);
  }
  if (!view_.ended) run(said);
  if (view_.ended || phase_ < Phase::before) gate_.stop();
  // The scale gives back what the pull stored in it, and gets it as the pull grows.
  const double pull = std::abs(wanted_n_[kAxis]);
  const double grown_j = std::max(0.0, 0.5 * (pull * pull - last_pull_n_ * last_pull_n_)) / kSpring_n_per_m;
  last_pull_n_ = pull;
  if (limit(view_, dt_s, grown_j, kSpring_n_per_m) && !view_.ended) fail(BringUpWhy::gate_stopped);
  if (view_.ended) view_.sent_n = Vec3(0.0);
}

void ForceCalibration::run(const CalibrationAnswer& said) noexcept {
  switch (phase_) {
    case Phase::attach:
    case Phase::identify:
      return find_device();
    case Phase::home:
      return home(said.said);
    case Phase::ask:
      return ask_step(said.said);
    default:
      return pull(said);
  }
}

// --- From step to step -----------------------------------------------------------------------------------

void ForceCalibration::enter(Phase phase) noexcept {
  phase_ = phase;
  phase_began_s_ = view_.t_s;
}

void ForceCalibration::ask(CalibrationAsk what, BringUpWhy again) noexcept {
  view_.ask = what;
  view_.again = again;
  ++view_.questions;
}

void ForceCalibration::fail(BringUpWhy why) noexcept {
  gate_.stop();
  wanted_n_ = Vec3(0.0);
  view_.end_with(why);
}

void ForceCalibration::pull_again(BringUpWhy why) noexcept {
  gate_.stop();
  wanted_n_ = Vec3(0.0);
  if (++tries_ >= kTries) return fail(why);
  enter(Phase::ask);
  ask(CalibrationAsk::pull, why);
}

void ForceCalibration::next_step() noexcept {
  gate_.stop();
  wanted_n_ = Vec3(0.0);
  view_.ask = CalibrationAsk::none;
  tries_ = 0;
  enter(Phase::ask);
  if (view_.step + 1 < falcon_scale_steps().size()) {
    ++view_.step;
  } else {
    view_.ended = view_.done = true;
  }
}

// --- Without force ---------------------------------------------------------------------------------------

void ForceCalibration::find_device() noexcept {
  const bool attached = sample_.state != DeviceState::absent;
  if (phase_ == Phase::attach) {
    if (attached) return enter(Phase::identify);
    if (in_phase_s() > kAttach_s) fail(BringUpWhy::not_attached);
  } else if (attached && sample_.state != DeviceState::open) {
    enter(Phase::home);
  } else if (in_phase_s() > kIdentify_s) {
    fail(attached ? BringUpWhy::no_firmware : BringUpWhy::not_attached);
  }
}

void ForceCalibration::home(BringUpAnswer said) noexcept {
  if (sample_.state == DeviceState::ready) {
    view_.ask = CalibrationAsk::none;
    return enter(Phase::ask);
  }
  if (said_home_) {
    if (in_phase_s() > std::max(kHomed_s, can_.homing_s)) fail(BringUpWhy::not_homed);
    return;
  }
  if (!view_.asks()) return ask(CalibrationAsk::home);
  if (said == BringUpAnswer::no || said == BringUpAnswer::skip) return fail(BringUpWhy::said_no);
  if (said != BringUpAnswer::yes) return;
  if (sample_.state == DeviceState::firmware) request_ = DeviceRequest::home;
  said_home_ = true;
  view_.ask = CalibrationAsk::none;
  enter(Phase::home);
}

bool ForceCalibration::within(double half_m) const noexcept {
  const Vec3& p = sample_.position_m;
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= half_m;
}

void ForceCalibration::ask_step(BringUpAnswer said) noexcept {
  const bool pulls = pull_n() != 0.0;
  if (!view_.asks()) return ask(pulls ? CalibrationAsk::pull : CalibrationAsk::done);
  if (said == BringUpAnswer::no || said == BringUpAnswer::skip) return fail(BringUpWhy::said_no);
  if (said != BringUpAnswer::yes) return;
  if (!pulls) return next_step();
  if (!within(kMiddle_m)) return pull_again(BringUpWhy::not_in_middle);
  view_.ask = CalibrationAsk::none;
  view_.again = BringUpWhy::none;
  pulled_.forget();
  gate_.arm();
  enter(Phase::before);
}

// --- A pull ----------------------------------------------------------------------------------------------

void ForceCalibration::pull(const CalibrationAnswer& said) noexcept {
  if (!within(kLeft_m) && phase_ != Phase::fall) return pull_again(BringUpWhy::not_in_middle);
  const double t_s = in_phase_s();
  switch (phase_) {
    case Phase::before:
      if (t_s >= kArm_s) enter(Phase::rise);
      break;
    case Phase::rise:
      wanted_n_[kAxis] = pull_n() * std::min(1.0, t_s / kPullRise_s);
      if (t_s >= kPullRise_s) enter(Phase::hold);
      break;
    case Phase::hold:
      wanted_n_[kAxis] = pull_n();
      hold(said);
      break;
    default:
      wanted_n_[kAxis] = pull_n() * std::max(0.0, 1.0 - t_s / kPullFall_s);
      if (t_s >= kPullFall_s) next_step();
  }
}

void ForceCalibration::hold(const CalibrationAnswer& said) noexcept {
  pulled_.add(sample_.force_n);
  if (in_phase_s() < kSteady_s) return;
  if (!view_.asks()) return ask(CalibrationAsk::reading);
  const bool refused = said.said == BringUpAnswer::no || said.said == BringUpAnswer::skip;
  if (refused || in_phase_s() > kReadWithin_s) return pull_again(BringUpWhy::no_reading);
  if (said.said == BringUpAnswer::yes) take_reading(said.read_n);
}

void ForceCalibration::take_reading(double read_n) noexcept {
  if (!(read_n > 0.0)) return pull_again(BringUpWhy::no_reading);
  const double rendered_n = std::abs(pulled_.mean()[kAxis]);
  // Less: near the edge of the workspace, or beyond the most counts.
  if (rendered_n < kOfAsked * std::min(std::abs(pull_n()), most_n_)) return pull_again(BringUpWhy::not_in_middle);
  if (view_.reading_count < view_.readings.size()) view_.readings[view_.reading_count++] = {rendered_n, read_n};
  const auto steps = falcon_scale_steps();
  const double next_n = view_.step + 1 < steps.size() ? std::abs(steps[view_.step + 1].push_n) : 0.0;
  if (read_n / rendered_n * next_n > kMostPull_n) return fail(BringUpWhy::pulls_too_hard);
  view_.ask = CalibrationAsk::none;
  enter(Phase::fall);
}

// --- Words -----------------------------------------------------------------------------------------------

std::optional<double> newtons_of_line(std::string_view line) {
  constexpr double kMostRead_n = 100.0;
  std::string text(line);
  if (const std::size_t comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0.0 && value <= kMostRead_n))
    return std::nullopt;
  return value;
}

Result<double> calibrated_scale(const CalibrationView& view, double used_scale) {
  if (view.done) return torque_scale_from({view.readings.data(), view.reading_count}, used_scale);
  return tangent::fail(view.ended ? why_text(view.why, view) : "it has not ended", "calibration", "begin again");
}

std::string yes_text(const CalibrationView& view) {
  std::array<char, 32> text;
  switch (view.ask) {
    case CalibrationAsk::none:
      return {};
    case CalibrationAsk::home:
      return "Begin";
    case CalibrationAsk::done:
      return "Done";
    case CalibrationAsk::pull:
      std::snprintf(text.data(), text.size(), "Pull with %.2g N", std::abs(falcon_scale_steps()[view.step].push_n));
      return text.data();
    case CalibrationAsk::reading:
      return "Take the reading";
  }
  return {};
}

std::string question_text(const CalibrationView& view, const ForceCapabilities& can) {
  std::string text;
  if (view.again != BringUpWhy::none) text = "Again: " + why_text(view.again, view);
  if (view.again == BringUpWhy::not_in_middle) {
    std::array<char, 96> place;
    const Vec3 p = 1e3 * view.position_m;
    std::snprintf(place.data(), place.size(), "; it is at %.0f %.0f %.0f mm, and each may be %.0f at most", p.x, p.y,
                  p.z, 1e3 * ForceCalibration::kMiddle_m);
    text += place.data();
  }
  text += text.empty() ? "" : ". ";
  const char* what = falcon_scale_steps()[view.step].what;
  switch (view.ask) {
    case CalibrationAsk::none:
      return {};
    case CalibrationAsk::home:
      return text + (can.homing_s > 0.0 ? "It homes now, and may move by itself: hands off. Go on?"
                                        : "Home it by hand: pull the grip all the way out and push it in. Begin?");
    case CalibrationAsk::done:
      return text + what + " Done?";
    case CalibrationAsk::pull:
      return text + what + " Pull?";
    case CalibrationAsk::reading:
      return text + "It pulls. What does the scale show, in newtons?";
  }
  return {};
}

}  // namespace tangent
