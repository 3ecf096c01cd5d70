// What a guided bring-up of a force device asks, measures and finds. Plain data, copied whole between threads. SI
// units, the device's frame unless stated otherwise.
#pragma once

#include "core/base/vec.h"
#include "devices/device_state.h"
#include "devices/gate/gate_words.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tangent {

/// In this order. From `push` on there is force.
enum class BringUpStep : std::uint8_t {
  cable,       ///< the device answers
  permission,  ///< it can be opened
  firmware,    ///< identified and supported; or the maker's library
  homing,      ///< finds its zero
  still,       ///< noise of the encoders at rest
  axes,        ///< signs and axes, by motions of a hand
  rate,        ///< exchanges per second, age, lost samples
  push,        ///< direction of force, in steps
  stop,        ///< a stop takes the force away
  watchdog,    ///< so does silence, by the device itself
  emergency,   ///< so does its other way to stop
  count_
};
inline constexpr std::size_t kBringUpSteps = static_cast<std::size_t>(BringUpStep::count_);

enum class StepVerdict : std::uint8_t {
  waiting,     ///< not begun
  running,     ///
  proved,      ///
  failed,      ///
  not_proved,  ///< left out by the person, or the device has no such thing
};

/// What the person is asked; the answer is yes unless stated otherwise.
enum class BringUpAsk : std::uint8_t {
  none,
  home,     ///< may it home? It may move by itself
  let_go,   ///< put the handle down, let go
  take,     ///< take the handle, hold it in the middle
  move,     ///< move it as asked_direction(axis), hold it there; skip: it can't be moved so
  push,     ///< may it push? yes before each
  moved,    ///< did it move as said? yes or no
  hold_on,  ///< a stop (watchdog, emergency stop) is tried in this push: go on?
};

enum class BringUpAnswer : std::uint8_t { none, yes, no, skip };

/// Why it ended, or a question is put again.
enum class BringUpWhy : std::uint8_t {
  none,
  not_attached,  ///< no answer in time
  no_firmware,   ///< not identified in time
  not_homed,     ///< no zero in time
  said_no,       ///< the person refused a step
  stopped,       ///< the person stopped
  left_ready,    ///< the device left `ready`: see device_fault
  gate_stopped,  ///< see gate_fault
  not_finite,    ///< a position that is not a number
  outside,       ///< far outside its workspace
  backwards,     ///< samples that go back in time
  silent,        ///< no new sample for too long
  noisy,         ///< at rest
  moved_too_little,
  moved_too_far,  ///< by hand: units?
  moved_crooked,  ///< along two axes alike
  axis_dead,      ///< nothing is read along an axis
  axis_wrong,     ///< another axis or sign than the frame says
  step_coarse,    ///< steps larger than its resolution says
  slow,           ///< fewer exchanges than it is designed for
  lost_samples,
  old_samples,
  push_too_far,     ///< the handle moved farther than this force moves one that is held
  force_too_large,  ///< the device says that it renders more than was sent
  force_reversed,   ///< it pushed the other way
  force_elsewhere,  ///< it pushed along another axis
  no_force,         ///< nothing moved up to the limit
  disagree,         ///< encoders and person say different things
  force_stays,      ///< after a stop
  not_in_middle,    ///< the handle is not in the middle of its range, or left it
  no_reading,       ///< of a scale, in time
  pulls_too_hard,   ///< by the scale, several times what was asked for
  hangs,            ///< the driver does not come back from an exchange
};

struct RestFacts {
  double seconds = 0.0;
  Vec3 noise_m{0.0};     ///< RMS about the mean
  double range_m = 0.0;  ///< largest minus smallest, of the worst axis
  std::uint32_t ticks = 0;
};

struct MotionFacts {
  Vec3 moved_m{0.0};  ///< in the device's frame, from the last answer to this one
  StepVerdict verdict = StepVerdict::waiting;
  BringUpWhy why = BringUpWhy::none;
};

struct RateFacts {
  double hz = 0.0, mean_age_s = 0.0, oldest_s = 0.0;
  std::uint32_t ticks = 0, lost = 0, late = 0;  ///< without a new sample in time; begun late
};

struct PushFacts {
  std::uint8_t axis = 0;  ///< of the device
  double force_n = 0.0;   ///< signed
  Vec3 moved_m{0.0};      ///< while held, against before and after
  double seen_m = 0.0;    ///< what counts as motion
  bool measured_right = false, said_right = false;
};

struct StopFacts {
  double force_n = 0.0, held_m = 0.0, left_m = 0.0;  ///< displacement under force, and 0.5 s after the stop
  std::uint32_t ticks_to_zero = 0;                   ///< until no force was sent
};

struct BringUpFacts {
  static constexpr std::size_t kMostPushes = 48;
  RestFacts rest;
  std::array<MotionFacts, 3> motions{};  ///< asked_direction(0) to (2)
  double smallest_step_m = 0.0;          ///< between readings in motion; 0: none seen
  RateFacts rate;
  std::array<PushFacts, kMostPushes> pushes{};
  std::size_t push_count = 0;
  StopFacts stop, watchdog, emergency;
};

/// Of an exchange with the device, and the gate before it.
struct ExchangeView {
  DeviceState device = DeviceState::absent;
  DeviceFault device_fault = DeviceFault::none;
  GateFault gate_fault = GateFault::none;
  Vec3 position_m{0.0}, sent_n{0.0};
  double t_s = 0.0;
};

/// What is shown.
struct BringUpView : ExchangeView {
  BringUpStep step = BringUpStep::cable;
  std::array<StepVerdict, kBringUpSteps> verdicts{};
  std::array<BringUpWhy, kBringUpSteps> whys{};
  BringUpAsk ask = BringUpAsk::none;
  BringUpWhy again = BringUpWhy::none;  ///< why the question is put again
  std::uint8_t axis = 0;                ///< of the question: motion (move), axis of the device (push)
  double force_n = 0.0;                 ///< of the question, signed
  double move_m = 0.05;                 ///< how far to move
  std::uint32_t questions = 0;          ///< so far; another number, another question
  bool ended = false;
  BringUpFacts facts;

  StepVerdict verdict(BringUpStep s) const { return verdicts[static_cast<std::size_t>(s)]; }
  BringUpWhy why(BringUpStep s) const { return whys[static_cast<std::size_t>(s)]; }
  bool asks() const { return ask != BringUpAsk::none; }
  /// The step under way failed; nothing is asked any more.
  void end_with(BringUpWhy why) noexcept {
    verdicts[static_cast<std::size_t>(step)] = StepVerdict::failed;
    whys[static_cast<std::size_t>(step)] = why;
    ask = BringUpAsk::none;
    ended = true;
  }
  /// No step failed, and all but those that the device has no such thing for were proved.
  bool all_proved() const;
};

}  // namespace tangent
