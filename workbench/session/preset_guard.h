// Takes a change of preset back that makes the safety gate act, in the servo's own tick.
//
// A change that comes while force is sent is on trial until it has been in contact for kTrial_s. When the gate acts
// within that time, the last preset known good is used again from the next tick on, faded in as every change is:
//   stopped   the gate stopped for a cause that a preset can have: shaking, a leap of finger or roller, not finite; a
//             display that stood still or failed, after a change of its controller; late ticks, where the solver
//             itself took longer than the servo's period since the change
//   limited   it limited how fast the force changes in kLimited of kLimitedOf ticks, which before the change it did
//   not.
//             One step of a coarse facet is not a loop that shakes; and a force at the device's peak is none either: it
//             is a hand that presses hard
//   energy    the loop has made kEnergyShare of the energy that stops it: springs and damped walls that are stable
//             reach half of that (devices/README.md)
// A stop stays a stop until a person arms again; the other two go on without one. Known good is what was in use when
// the trial began, or has come through one. Letters that were sent before their sender knew are dropped.
//
// Plain state and arithmetic: no clock, no allocation, no lock; one thread (the servo's) at a time.
#pragma once

#include "core/preset/preset.h"
#include "devices/safety_gate.h"

#include <array>
#include <cstdint>
#include <string>
#include <type_traits>

namespace tangent {

/// A preset on its way to the servo.
struct PresetLetter {
  std::uint32_t id = 0;
  Preset preset;
  bool guarded = false;           ///< taken back where it makes the gate act
  std::uint32_t undone_seen = 0;  ///< PresetUndone::count as its sender knew it
};
static_assert(std::is_trivially_copyable_v<PresetLetter>, "presets cross threads as bytes");

enum class UndoneBecause : std::uint8_t { none, stopped, limited, energy };

/// What was taken back last, for who sent it.
struct PresetUndone {
  std::uint32_t count = 0;    ///< since the servo began; 0: nothing was
  std::uint32_t bad_id = 0;   ///< on trial
  std::uint32_t good_id = 0;  ///< used again
  UndoneBecause why = UndoneBecause::none;
  GateFault fault = GateFault::none;  ///< where it was stopped
  std::uint64_t tick = 0;             ///< in which the gate acted; the next one uses the good preset
};
static_assert(std::is_trivially_copyable_v<PresetUndone>);

/// "the safety gate stopped the force: shaking".
std::string to_text(const PresetUndone& undone);

class PresetGuard {
 public:
  static constexpr double kTrial_s = 2.0;
  static constexpr double kEnergyShare = 0.7;
  static constexpr int kLimited = 3, kLimitedOf = 4;
  static constexpr int kLimitedBefore = 250;  ///< ticks before a change in which a limited force excuses it

  /// A letter came. `live`: the gate lets force through. False: it is to be dropped.
  bool take(const PresetLetter& letter, const PresetLetter& in_use, bool live) noexcept;
  /// Once a tick, after the gate. Returns what to use from the next tick on; null: nothing changes.
  /// `overran`: this tick's solver took longer than the servo's period.
  const PresetLetter* watch(const GateOutput& gate, const EnergyWatch& energy, const PresetLetter& in_use,
                            std::uint64_t tick, double dt_s, bool overran = false) noexcept;
  const PresetUndone& undone() const { return undone_; }
  bool on_trial() const { return trial_left_s_ > 0.0; }

 private:
  UndoneBecause acts(const GateOutput& gate, const EnergyWatch& energy, const Preset& in_use) const noexcept;
  bool by_preset(GateFault fault, const Preset& in_use) const noexcept;
  void note_limits(const GateOutput& gate) noexcept;

  PresetLetter good_;
  PresetUndone undone_;
  double trial_left_s_ = 0.0;
  std::uint32_t limited_ = 0;  ///< of the last 32 ticks, bit by bit
  int since_limited_ = kLimitedBefore;
  bool excused_ = false;  ///< the force was limited before the change, too
  int overran_ = 0;       ///< ticks since the change
  GateState last_state_ = GateState::disarmed;
};

}  // namespace tangent
