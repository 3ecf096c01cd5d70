#include "workbench/bringup/bring_up_text.h"

#include "workbench/bringup/axis_check.h"

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace tangent {
namespace {

struct StepName {
  const char* title;
  const char* word;
};
constexpr std::array<StepName, kBringUpSteps> kSteps{{{"Cable", "cable"},
                                                      {"Permission", "permission"},
                                                      {"Firmware or library", "firmware"},
                                                      {"Homing", "homing"},
                                                      {"At rest", "still"},
                                                      {"Axes and signs", "axes"},
                                                      {"Rate", "rate"},
                                                      {"Direction of force", "push"},
                                                      {"Stop", "stop"},
                                                      {"Watchdog", "watchdog"},
                                                      {"Other way to stop", "emergency"}}};

[[gnu::format(printf, 1, 2)]] std::string text_of(const char* pattern, ...) {
  std::array<char, 512> line;
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(line.data(), line.size(), pattern, values);
  va_end(values);
  return line.data();
}

/// Where a push along an axis of the device goes, for the person.
const char* push_direction(const ForceCapabilities& can, std::size_t axis, double force_n) {
  Vec3 v(0.0);
  v[static_cast<int>(axis)] = force_n;
  return direction_text(can.frame.rotation * v);
}

const char* plain_text(BringUpWhy why) {
  switch (why) {
    case BringUpWhy::not_attached:
      return "nothing answers; plug the device in, switch it on, and see `workbench devices` for the reason";
    case BringUpWhy::no_firmware:
      return "it is attached but does not say what it is; load its firmware, or update its library";
    case BringUpWhy::not_homed:
      return "it was not homed in time; move the handle through its whole range, and begin again";
    case BringUpWhy::said_no:
      return "it was refused; begin again when it may";
    case BringUpWhy::stopped:
      return "stopped by the person";
    case BringUpWhy::not_finite:
      return "a position was not a number: do not use the device with this driver";
    case BringUpWhy::outside:
      return "a position was far outside the workspace: check its units, its homing, its cable";
    case BringUpWhy::backwards:
      return "samples go back in time: the driver mixes up their order or their clock";
    case BringUpWhy::silent:
      return "no new sample came for 0.1 s: check the cable, and that nothing else uses the device";
    case BringUpWhy::noisy:
      return "the reading is not at rest: let go of the handle; else check cable, shield and power supply";
    case BringUpWhy::moved_too_little:
      return "too short to judge: move it farther";
    case BringUpWhy::moved_too_far:
      return "farther than anybody moves it: check the driver's units";
    case BringUpWhy::moved_crooked:
      return "along two axes alike: move it straight";
    case BringUpWhy::axis_dead:
      return "nothing is read of that motion: check that axis' encoder and its cable";
    case BringUpWhy::step_coarse:
      return "the steps of the reading are more than three times what the device says: check its units and encoders";
    case BringUpWhy::slow:
      return "fewer exchanges than it is designed for: close other programs, use another USB port";
    case BringUpWhy::lost_samples:
      return "more than 1 % of the samples did not come in time: use another USB port or cable";
    case BringUpWhy::old_samples:
      return "a sample was older than 10 ms, the oldest that may make a force: use another USB port or cable";
    case BringUpWhy::push_too_far:
      return "the handle moved farther than this force moves one that is held, so the force was taken away: hold it "
             "more "
             "firmly; if it goes on, the force is too large: check its scale in the driver";
    case BringUpWhy::force_too_large:
      return "the device says that it renders more than was sent: check the scale of forces in the driver";
    case BringUpWhy::force_reversed:
      return "it pushed the other way: turn the sign of that axis' force in the driver";
    case BringUpWhy::force_elsewhere:
      return "it pushed along another axis: the driver mixes up its motors";
    case BringUpWhy::no_force:
      return "nothing moved up to the limit: check the amplifier's power, its enable switch and the motors' cables";
    case BringUpWhy::disagree:
      return "encoders and person say different things: push again, hold gently, answer what you felt";
    case BringUpWhy::force_stays:
      return "the handle did not go back when the force was taken away: hold it gently; if it goes on, keep a hand on "
             "the power switch, and do not use it";
    case BringUpWhy::not_in_middle:
      return "the handle was not in the middle of its range, so there is no force";
    case BringUpWhy::no_reading:
      return "nothing was read, so the force was taken away";
    case BringUpWhy::pulls_too_hard:
      return "it pulls several times what is asked for: begin again with a lower --falcon-torque-scale";
    case BringUpWhy::hangs:
      return "its driver does not come back from an exchange: take the device's power away, then start the program "
             "again";
    default:
      return "";
  }
}

std::string push_line(const PushFacts& p, const ForceCapabilities& can) {
  return text_of("%+.2f N, %s: moved %.2f mm, %s", p.force_n, push_direction(can, p.axis, p.force_n),
                 1e3 * glm::length(p.moved_m),
                 p.measured_right && p.said_right ? "as it should, by encoders and person"
                 : p.measured_right               ? "as it should by the encoders; not by the person"
                 : p.said_right                   ? "as it should by the person; not seen by the encoders"
                                                  : "not as it should");
}

std::string stop_line(const StopFacts& s, StepVerdict verdict) {
  if (s.force_n == 0.0) return {};
  return text_of("from %.2f N: %u ticks to zero; held %.2f mm, then %.2f mm%s", s.force_n, s.ticks_to_zero,
                 1e3 * s.held_m, 1e3 * s.left_m, verdict == StepVerdict::not_proved ? "; it has none" : "");
}

/// Never "-0.0".
double tenths_mm(double metres) { return 0.1 * std::round(1e4 * metres) + 0.0; }

std::string axes_facts(const BringUpView& view, const ForceCapabilities& can) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const MotionFacts& m = view.facts.motions[i];
    if (m.verdict == StepVerdict::waiting) continue;
    text += text.empty() ? "" : "; ";
    text += direction_text(asked_direction(i));
    text += m.why == BringUpWhy::said_no ? std::string(": left out")
                                         : text_of(": read %.1f %.1f %.1f mm", tenths_mm(m.moved_m.x),
                                                   tenths_mm(m.moved_m.y), tenths_mm(m.moved_m.z));
  }
  if (view.facts.smallest_step_m > 0.0 && !text.empty())
    text += text_of("; smallest step %.0f um, it says %.0f um", 1e6 * view.facts.smallest_step_m,
                    1e6 * can.position_resolution_m);
  return text;
}

}  // namespace

const char* step_title(BringUpStep step) { return kSteps[static_cast<std::size_t>(step)].title; }
const char* step_word(BringUpStep step) { return kSteps[static_cast<std::size_t>(step)].word; }

const char* to_string(StepVerdict verdict) {
  constexpr std::array<const char*, 5> kWords{"not reached", "under way", "proved", "failed", "not proved"};
  return kWords[static_cast<std::size_t>(verdict)];
}

std::string question_text(const BringUpView& view, const ForceCapabilities& can) {
  std::string text;
  if (view.again != BringUpWhy::none) text = std::string("Again: ") + plain_text(view.again) + ". ";
  switch (view.ask) {
    case BringUpAsk::none:
      return {};
    case BringUpAsk::home:
      return text + (can.homing_s > 0.0 ? "It homes now, and may move by itself: hands off. Go on?"
                                        : "Home it by hand, as its page says. Begin?");
    case BringUpAsk::let_go:
      return text + "Put the handle down so that it stays by itself, and let go. At rest?";
    case BringUpAsk::take:
      return text + "Take the handle and hold it in the middle of its range. Held?";
    case BringUpAsk::move:
      return text + text_of("Move the handle %s by about %.0f mm, and hold it there. There?",
                            direction_text(asked_direction(view.axis)), 1e3 * view.move_m);
    case BringUpAsk::push:
      return text + text_of("Hold the handle gently. It will push %s with %.2g N for a second. Push?",
                            push_direction(can, view.axis, view.force_n), std::abs(view.force_n));
    case BringUpAsk::moved:
      return text + text_of("Did it push %s?", push_direction(can, view.axis, view.force_n));
    case BringUpAsk::hold_on:
      return text + text_of("Hold the handle gently. It will push %s with %.2g N; then %s. Push?",
                            push_direction(can, view.axis, view.force_n), std::abs(view.force_n),
                            view.step == BringUpStep::stop ? "a stop takes the force away"
                            : view.step == BringUpStep::watchdog
                                ? "nothing is sent, and the device has to stop by itself"
                                : "its other way to stop is tried");
  }
  return {};
}

std::string yes_text(const BringUpView& view, const ForceCapabilities& can) {
  switch (view.ask) {
    case BringUpAsk::none:
      return {};
    case BringUpAsk::home:
      return "Home";
    case BringUpAsk::let_go:
      return "It is at rest";
    case BringUpAsk::take:
      return "I hold it";
    case BringUpAsk::move:
      return "It is there";
    case BringUpAsk::moved:
      return std::string("It pushed ") + push_direction(can, view.axis, view.force_n);
    case BringUpAsk::push:
    case BringUpAsk::hold_on:
      return text_of("Push with %.2g N", std::abs(view.force_n));
  }
  return {};
}

std::string no_text(const BringUpView& view) {
  if (view.ask == BringUpAsk::moved) return "It did not";
  return view.ask == BringUpAsk::home || view.ask == BringUpAsk::push ? "No" : "";
}

bool may_skip(const BringUpView& view) {
  return view.ask == BringUpAsk::let_go || view.ask == BringUpAsk::move || view.ask == BringUpAsk::hold_on;
}

std::string step_facts_text(BringUpStep step, const BringUpView& view, const ForceCapabilities& can) {
  const BringUpFacts& f = view.facts;
  switch (step) {
    case BringUpStep::still:
      if (f.rest.ticks == 0) return {};
      return text_of("noise %.0f %.0f %.0f um RMS, range %.0f um, in %.1f s", 1e6 * f.rest.noise_m.x,
                     1e6 * f.rest.noise_m.y, 1e6 * f.rest.noise_m.z, 1e6 * f.rest.range_m, f.rest.seconds);
    case BringUpStep::axes:
      return axes_facts(view, can);
    case BringUpStep::rate:
      if (f.rate.hz <= 0.0) return {};
      return text_of("%.1f Hz, age %.2f ms, oldest %.2f ms, %u of %u samples late, %u ticks begun late", f.rate.hz,
                     1e3 * f.rate.mean_age_s, 1e3 * f.rate.oldest_s, f.rate.lost, f.rate.ticks, f.rate.late);
    case BringUpStep::push:
      if (f.push_count == 0) return {};
      return text_of("%zu push%s; the last ", f.push_count, f.push_count == 1 ? "" : "es") +
             push_line(f.pushes[f.push_count - 1], can);
    case BringUpStep::stop:
      return stop_line(f.stop, view.verdict(step));
    case BringUpStep::watchdog:
      return can.firmware_timeout_s > 0.0 ? stop_line(f.watchdog, StepVerdict::proved) : "its firmware has none";
    case BringUpStep::emergency:
      return stop_line(f.emergency, view.verdict(step));
    default:
      return {};
  }
}

std::string why_text(BringUpWhy why, const ExchangeView& view) {
  if (why == BringUpWhy::left_ready)
    return std::string("the device left `ready`: ") + to_string(view.device_fault) + "; see its cable and power";
  if (why == BringUpWhy::gate_stopped)
    return std::string("the safety gate stopped: ") + to_string(view.gate_fault) +
           "; hold the handle gently and begin again";
  return plain_text(why);
}

std::string step_why_text(BringUpStep step, const BringUpView& view, const ForceCapabilities& can) {
  const BringUpWhy why = view.why(step);
  return why == BringUpWhy::axis_wrong ? axes_text(view.facts.motions, can.frame) : why_text(why, view);
}

std::vector<std::string> not_proved_lines(const BringUpView& view, const ForceCapabilities& can) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < kBringUpSteps; ++i) {
    const auto step = static_cast<BringUpStep>(i);
    if (view.verdicts[i] != StepVerdict::proved)
      lines.push_back(std::string(step_title(step)) + ": " + to_string(view.verdicts[i]));
  }
  lines.push_back("the size of the force: no scale measured it; a held handle moved no farther than it should");
  if (can.continuous_force_n <= 0.0) lines.push_back("the continuous force: the device does not say it");
  lines.push_back("forces above the limit of this bring-up, stability in contact, heat");
  if (can.simulated) lines.push_back("anything about a real device: this one is simulated");
  return lines;
}

}  // namespace tangent
