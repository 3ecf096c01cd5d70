// Guided bring-up of a force device: step by step from the cable to the force, each shown by something measured. It
// moves nothing until a person says yes; force begins at 0.1 N and doubles, with a yes before each push, through a
// safety gate with tight limits. Anything wrong ends with zero force and a reason.
//
// Pure: no clock, no thread, no allocation, no lock. A caller opens the device, calls `tick` at the servo's rate, shows
// `view` (bring_up_text.h), and passes on the person's answers; bring_up_runner.h is one. The device is closed by the
// caller, after `ended` or at any time.
#pragma once

#include "workbench/bringup/guarded_exchange.h"
#include "workbench/bringup/running_mean.h"

#include <atomic>
#include <utility>

namespace tangent {

struct BringUpOptions {
  double rate_hz = 1000.0;  ///< of the ticks
  double first_n = 0.1;     ///< first push
  double most_n = 1.0;      ///< last; never above the device's continuous force, or its peak where that is not known
};

class BringUp : private GuardedExchange {
 public:
  using Options = BringUpOptions;
  using View = BringUpView;
  using Answer = BringUpAnswer;
  static constexpr int kTries = 3;                   ///< before a question that was answered badly fails its step
  static constexpr double kSoftest_n_per_m = 100.0;  ///< hand that holds: pushes move it no farther than this allows,
  static constexpr double kDrift_m = 2e-3;           ///< and this much more

  /// `device`: open, and not yet ready; must outlive this.
  BringUp(ForceDevice& device, const BringUpOptions& options);

  /// One exchange, `dt_s` > 0 after the last. Same thread each time.
  void tick(double dt_s) noexcept;
  /// Any thread; the last one before a tick counts. `question`: the view's `questions`. An answer to another question
  /// than the one that is asked is dropped: a second press never becomes a yes to the next push.
  void answer(BringUpAnswer answer, std::uint32_t question) noexcept {
    answer_.store(std::uint64_t{question} << 8 | static_cast<std::uint64_t>(answer), std::memory_order_relaxed);
  }
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }  ///< any thread; at any time
  /// Thread of the ticks.
  const BringUpView& view() const { return view_; }
  /// Largest force that will be asked for, N.
  double most_n() const { return most_n_; }

 private:
  enum class Phase : std::uint8_t { ask, before, rise, hold, silent, fall, after, judge };
  enum class Pushed : std::uint8_t { right, reversed, elsewhere, nowhere, stays };

  // Every tick.
  BringUpAnswer take_answer() noexcept;
  // Steps, each until it calls pass or fail.
  void wait_for_device() noexcept;
  void home(BringUpAnswer said) noexcept;
  void rest(BringUpAnswer said) noexcept;
  void move(BringUpAnswer said) noexcept;
  void judge_motion() noexcept;
  void judge_axes() noexcept;
  void measure_rate(double dt_s) noexcept;
  void push(BringUpAnswer said) noexcept;
  void judge_push(bool said_right) noexcept;
  Pushed measured_push(PushFacts& push) const noexcept;
  void next_push() noexcept;
  void first_push() noexcept;
  void try_stop(BringUpAnswer said) noexcept;
  void judge_stop(StopFacts& facts) noexcept;
  void start_push() noexcept;
  bool run_push() noexcept;  ///< rise, hold and fall; true when it is over
  void take_force_away() noexcept;
  double silence_s() const noexcept;
  bool went_too_far() noexcept;
  void recover(BringUpAnswer said) noexcept;

  void begin(BringUpStep step) noexcept;
  void pass(StepVerdict verdict = StepVerdict::proved) noexcept;
  void fail(BringUpWhy why) noexcept;
  void ask(BringUpAsk what, BringUpWhy again = BringUpWhy::none) noexcept;
  /// Puts the question again, or fails after kTries.
  void ask_again(BringUpAsk what, BringUpWhy why) noexcept;
  bool has_force() const noexcept { return view_.step >= BringUpStep::push && !view_.ended; }
  double in_step_s() const noexcept { return view_.t_s - step_began_s_; }
  double in_phase_s() const noexcept { return view_.t_s - phase_began_s_; }
  void enter(Phase phase) noexcept;

  BringUpOptions options_;
  std::atomic<std::uint64_t> answer_{0};  ///< question and answer
  std::atomic<bool> stop_{false};
  BringUpView view_;
  Phase phase_ = Phase::ask;
  double step_began_s_ = 0.0, phase_began_s_ = 0.0;
  int tries_ = 0;
  bool said_home_ = false;
  bool homes_again_ = false;      ///< in this step, after a yes
  double recovers_from_s_ = 0.0;  ///< the last yes to homing, push, or when the step began
  double unsent_s_ = 0.0;         ///< since the last exchange, while it is silent on purpose
  Vec3 last_m_{0.0}, from_m_{0.0};
  RunningMean mean_, before_, held_, after_;  ///< at rest; of a push
  double level_n_ = 0.0;
  bool cut_ = false;             ///< the force of this push was taken away,
  std::uint32_t cut_ticks_ = 0;  ///< and was still there for so many ticks
  bool has_none_ = false;        ///< no emergency stop
};

}  // namespace tangent
