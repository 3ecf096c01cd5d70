// Guided calibration of a Falcon's torque scale with a spring scale (devices/falcon/falcon_calibration.h says the steps
// and what follows from the readings). The device pulls only after a yes, a yes for each pull; while it pulls, the
// person reads the scale. It pulls no more than kMostPull_n by the readings, through a safety gate with tight limits,
// and only while the grip is in the middle. Anything wrong ends with zero force and a reason.
//
// Pure, as bring_up.h: no clock, no thread, no allocation, no lock. guided_runner.h runs it.
#pragma once

#include "core/base/result.h"
#include "devices/falcon/falcon_calibration.h"
#include "workbench/bringup/guarded_exchange.h"
#include "workbench/bringup/running_mean.h"

#include <atomic>
#include <optional>
#include <string_view>

namespace tangent {

/// What the person is asked; the answer is yes unless stated otherwise.
enum class CalibrationAsk : std::uint8_t {
  none,
  home,     ///< may it home?
  done,     ///< is it done as the step says?
  pull,     ///< may it pull? yes before each
  reading,  ///< what does the scale show? a number; it pulls meanwhile
};

struct CalibrationAnswer {
  BringUpAnswer said = BringUpAnswer::none;
  double read_n = 0.0;  ///< with yes, to `reading`
};

struct CalibrationView : ExchangeView {
  static constexpr std::size_t kMostReadings = 8;
  CalibrationAsk ask = CalibrationAsk::none;
  BringUpWhy again = BringUpWhy::none;  ///< why the question is put again
  BringUpWhy why = BringUpWhy::none;    ///< why it ended before it was done
  std::size_t step = 0;                 ///< of falcon_scale_steps()
  std::uint32_t questions = 0;          ///< so far; another number, another question
  bool ended = false, done = false;     ///< done: all steps were gone through
  std::array<FalconReading, kMostReadings> readings{};
  std::size_t reading_count = 0;
  bool asks() const { return ask != CalibrationAsk::none; }
  /// Nothing is asked any more.
  void end_with(BringUpWhy ended_why) noexcept {
    why = ended_why;
    ask = CalibrationAsk::none;
    ended = true;
  }
};

struct CalibrationOptions {
  double rate_hz = 1000.0;  ///< of the ticks
};

class ForceCalibration : private GuardedExchange {
 public:
  using Options = CalibrationOptions;
  using View = CalibrationView;
  using Answer = CalibrationAnswer;
  static constexpr int kTries = 3;               ///< of a pull, before it fails
  static constexpr int kAxis = 2;                ///< of the device, that it pulls along
  static constexpr double kMostAsked_n = 1.0;    ///< by the steps
  static constexpr double kMostPull_n = 3.0;     ///< by the scale: a pull that would be harder isn't made
  static constexpr double kMiddle_m = 15e-3;     ///< about the origin, along each axis, before a pull
  static constexpr double kLeft_m = 25e-3;       ///< and while it pulls
  static constexpr double kReadWithin_s = 60.0;  ///< a pull lasts no longer

  /// `device`: open, and not yet ready; must outlive this.
  ForceCalibration(ForceDevice& device, const CalibrationOptions& options);

  /// One exchange, `dt_s` > 0 after the last. Same thread each time.
  void tick(double dt_s) noexcept;
  /// Any thread, one at a time; the last one before a tick counts. To another question than the one that is asked: it
  /// is dropped.
  void answer(const CalibrationAnswer& answer, std::uint32_t question) noexcept;
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }  ///< any thread; at any time
  /// Thread of the ticks.
  const CalibrationView& view() const { return view_; }

 private:
  enum class Phase : std::uint8_t { attach, identify, home, ask, before, rise, hold, fall };

  CalibrationAnswer take_answer() noexcept;
  void run(const CalibrationAnswer& said) noexcept;
  void find_device() noexcept;
  void home(BringUpAnswer said) noexcept;
  void ask_step(BringUpAnswer said) noexcept;
  void pull(const CalibrationAnswer& said) noexcept;
  void hold(const CalibrationAnswer& said) noexcept;
  void take_reading(double read_n) noexcept;
  void next_step() noexcept;
  void ask(CalibrationAsk what, BringUpWhy again = BringUpWhy::none) noexcept;
  void pull_again(BringUpWhy why) noexcept;
  void fail(BringUpWhy why) noexcept;
  void enter(Phase phase) noexcept;
  double pull_n() const noexcept { return falcon_scale_steps()[view_.step].push_n; }
  bool within(double half_m) const noexcept;
  double in_phase_s() const noexcept { return view_.t_s - phase_began_s_; }

  std::atomic<std::uint64_t> answer_{0};  ///< question, 0.1 mN read, answer
  std::atomic<bool> stop_{false};
  CalibrationView view_;
  Phase phase_ = Phase::attach;
  double phase_began_s_ = 0.0;
  double last_pull_n_ = 0.0;  ///< asked of the gate in the last tick
  bool said_home_ = false;
  int tries_ = 0;
  RunningMean pulled_;  ///< force that the device says it renders, N
};

/// "0.27", or "0,27" as scales are read elsewhere; null: no number above 0 and up to 100.
std::optional<double> newtons_of_line(std::string_view line);

/// The scale that follows, for one that was used. Fails where it was not gone through, and as torque_scale_from does.
/// Not in the thread of the ticks.
Result<double> calibrated_scale(const CalibrationView& view, double used_scale);

/// What the button or the key "yes" means now: "Pull with 0.25 N", "Done"; empty: nothing is asked.
std::string yes_text(const CalibrationView& view);
/// What the person is to do, and why it is asked again; empty: nothing. Not in the thread of the ticks.
std::string question_text(const CalibrationView& view, const ForceCapabilities& can);

}  // namespace tangent
