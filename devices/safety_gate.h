// The safety gate: the only path from a tick's output to the devices, simulated ones included.
//
// A tick calls it twice. `before_sending`, before the exchange with the devices, decides whether the force of the last
// tick may still be sent: after a stop, a fault or a stall it is zero. `pass`, after the tick was computed, checks and
// limits the new force, in this order:
//   finite check          force, display target and measured position; not finite: stop
//   devices               left ready while armed: stop
//   freshness             late ticks or a stale sample: force to zero within two ticks, then stop
//   plausible positions   faster than any hand, or frozen while moving: stop
//   energy                more put out than the hand put in: stop (gate/energy.h)
//   workspace             the force fades out over the margin beyond the device's box
//   force                 peak clamp; continuous clamp by the motors' heat; slew limit; ramp-in after arming
//   display               target clamped to the travel and to its fastest motion
// A stop latches a fault until a person re-arms. Time is the devices' time (dt_s): a simulated device waits for a late
// tick, a real one does not. SI units. Plain state and arithmetic: no clock, no allocation, no lock; one
// thread (the servo's) at a time. All vectors are in the device's frame.
#pragma once

#include "core/base/vec.h"
#include "devices/device_state.h"
#include "devices/gate/energy.h"
#include "devices/gate/freshness.h"
#include "devices/gate/gate_words.h"
#include "devices/gate/heat.h"
#include "devices/gate/limits.h"
#include "devices/gate/motion.h"

#include <array>
#include <cstdint>

namespace tangent {

struct GateInput {
  Vec3 force_n{0.0};
  double display_m = 0.0;
  DeviceState force_device = DeviceState::absent;
  DeviceState display = DeviceState::absent;  ///< absent: none, which is no fault
  Vec3 position_m{0.0};                       ///< of the finger, as measured
  double position_age_s = 0.0;                ///< since it was measured
  double display_measured_m = 0.0;            ///< of the roller
  double display_age_s = 0.0;
  double display_travel_m = 0.0;  ///< as reported by the display, 0: not known; the smaller one limits
  double display_lowest_m = -1.0, display_highest_m = 1.0;  ///< requested range of targets, within the travel
  bool display_measures = false;                            ///< display_measured_m comes from a sensor
  double display_fastest_m_per_s = 0.0;  ///< requested limit of the target's speed; 0: the gate's own
  double stiffness_n_per_m = 0.0;  ///< of the surface that made the force, at the device; 0: none, it stores no energy
  double elastic_n = 0.0;          ///< stiffness times depth, without any limit
  double declared_j = 0.0;         ///< put out on purpose by this force, see gate/energy.h
};

struct GateOutput {
  Vec3 force_n{0.0};
  double display_m = 0.0;
  GateState state = GateState::disarmed;
  GateFault fault = GateFault::none;
  GateActions actions = 0;
  bool did(GateAction action) const { return (actions >> static_cast<unsigned>(action)) & 1u; }
};

class SafetyGate {
 public:
  /// With limits that check_limits refuses it passes no force.
  explicit SafetyGate(const GateLimits& limits);

  /// Starts the ramp; also re-arms after a fault. Takes effect as soon as the force device is ready.
  void arm() noexcept;
  /// Disarms: no force from now on, that of the last pass included.
  void stop() noexcept;
  /// Stops by a fault that is seen elsewhere. Nothing when it is not armed.
  void stop_by(GateFault fault) noexcept;
  /// Restarts the ramp if armed, and does not compare the next position with the last (the scene was replaced).
  void restart_ramp() noexcept;

  /// At the start of every tick, `dt_s` after the last: the force to send in this tick's exchange. It is that of the
  /// last pass, unless the gate was stopped or this tick is late.
  Vec3 before_sending(double dt_s) noexcept;
  /// Checks and limits one tick's output. Precondition: dt_s > 0. Failures show in the output's fault.
  GateOutput pass(const GateInput& input, double dt_s) noexcept;

  /// Counts and says that a change of preset was taken back because of what the last pass did or saw. After pass.
  void note_undone(GateOutput& out) noexcept { note(GateAction::preset_undone, out); }

  const GateLimits& limits() const { return limits_; }
  GateState state() const { return state_; }
  /// Whether a force may go out in the next exchange.
  bool may_send() const { return live() || falling_ || half_to_send_; }
  GateFault fault() const { return fault_; }
  /// Ticks in which each action was taken, by GateAction.
  const std::array<std::uint64_t, kGateActionCount>& counts() const { return counts_; }
  std::uint64_t faults() const { return faults_; }  ///< number of stops by a fault
  const EnergyWatch& energy() const { return energy_; }
  ForceBudget& heat() { return heat_; }

 private:
  bool live() const noexcept { return state_ == GateState::ramping || state_ == GateState::armed; }
  void latch(GateFault fault) noexcept;
  void latch_falling(GateFault fault) noexcept;
  void forget_motion() noexcept;
  void spend_heat(double dt_s) noexcept;
  bool check_finite(const GateInput& input, GateOutput& out) noexcept;
  void watch_devices(const GateInput& input) noexcept;
  void watch_freshness(const GateInput& input, double dt_s) noexcept;
  void watch_position(const GateInput& input, double dt_s) noexcept;
  void watch_energy(const GateInput& input, const MotionStep& step, double dt_s) noexcept;
  void watch_roller(const GateInput& input, double dt_s) noexcept;
  Vec3 limit_force(const GateInput& input, double dt_s, GateOutput& out) noexcept;
  void note_wall(const GateInput& input, double share, double limit_n) noexcept;
  double workspace_share(const Vec3& position_m) const noexcept;
  double ramp_share(double dt_s) noexcept;
  void pass_display(const GateInput& input, double dt_s, GateOutput& out) noexcept;
  void note(GateAction action, GateOutput& out) noexcept;

  GateLimits limits_;
  GateState state_ = GateState::disarmed;
  GateFault fault_ = GateFault::none;
  bool force_was_ready_ = false, display_was_ready_ = false;  ///< since armed
  bool falling_ = false;                                      ///< one more pass at reduced force, then zero
  bool half_to_send_ = false;                                 ///< that pass was made, and its force not yet sent
  double since_armed_s_ = 0.0;
  double sample_age_s_ = 0.0;  ///< of the sample that the last force was computed from
  Vec3 last_force_n_{0.0};
  double last_display_m_ = 0.0;
  LatenessWatch lateness_;
  MotionWatch finger_, roller_;
  FrozenPositionWatch frozen_;
  FrozenDisplayWatch display_frozen_;
  ForceHistory sent_;
  EnergyWatch energy_;
  RenderedWall wall_;        ///< of the last force
  double declared_j_ = 0.0;  ///< since the last pass
  ForceBudget heat_;
  bool heat_is_spent_ = false;  ///< of this tick, by before_sending
  std::array<std::uint64_t, kGateActionCount> counts_{};
  std::uint64_t faults_ = 0;
};

}  // namespace tangent
