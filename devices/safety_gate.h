// The safety gate: the only path from a tick's output to the devices, simulated ones included.
//
// What it checks and limits, in this order:
//   finite check          force, display target and measured position; not finite: stop
//   devices               left ready while armed: stop
//   freshness             late tick or stale sample: force to zero within two ticks, then stop
//   plausible positions   faster than any hand, or frozen while moving: stop
//   workspace             the force fades out over the margin beyond the device's box
//   force                 peak clamp; continuous clamp by the motors' heat; slew limit; ramp-in after arming
//   shaking               net work of an unstable loop on the hand: force reduced, then stop
//   display               target clamped to the travel
// A stop latches a fault until a person re-arms. Time is the devices' time (dt_s): a simulated device waits for a late
// tick, a real one does not. SI units, world frame. Plain state and arithmetic: no clock, no allocation, no lock; one
// thread (the servo's) at a time.
#pragma once

#include "core/base/vec.h"
#include "devices/device_state.h"
#include "devices/gate_watches.h"

#include <array>
#include <cstdint>

namespace tangent {

enum class GateState : std::uint8_t {
  disarmed,  ///< no force
  ramping,   ///< armed, force being ramped in
  armed,
  faulted,  ///< no force until re-armed
};

enum class GateFault : std::uint8_t {
  none,
  force_not_finite,
  display_not_finite,
  force_device,     ///< left ready while armed
  contact_display,  ///< left ready while armed
  position_not_finite,
  position_jumped,  ///< moved faster than any hand
  position_frozen,  ///< was moving, then read the same for 20 ticks
  display_jumped,   ///< the roller moved faster than any drive
  display_frozen,   ///< far from its target, and read the same for 50 ticks
  stale_sample,     ///< no new measurement in time
  late_tick,
  shaking,  ///< the loop did work on the hand
};

/// What the gate changed in a tick's output.
enum class GateAction : std::uint8_t {
  force_clamped,       ///< above the device's peak force
  slew_limited,        ///< changed faster than allowed
  ramped_in,           ///< reduced by the ramp after arming
  display_clamped,     ///< beyond the display's travel
  refused_not_finite,  ///< not finite: zero force, display held
  withheld,            ///< a force was asked for while disarmed, faulted or not yet ready
  workspace_faded,     ///< reduced outside the device's workspace
  heat_clamped,        ///< above the thermal limit
  shake_reduced,       ///< reduced because the loop shakes
  ramped_out,          ///< being reduced to zero after a late tick or a stale sample
  count_
};
inline constexpr std::size_t kGateActionCount = static_cast<std::size_t>(GateAction::count_);
using GateActions = std::uint16_t;  ///< bit per GateAction
static_assert(kGateActionCount <= 16);

const char* to_string(GateState state);
const char* to_string(GateFault fault);
const char* to_string(GateAction action);

struct GateLimits {
  double peak_force_n = 0.0;        ///< of the device; 0: no force at all
  double slew_n_per_s = 2000.0;     ///< fastest change of the force; does not delay the drop to zero of a stop or fault
  double ramp_s = 0.25;             ///< from arming to full force
  double display_travel_m = 0.0;    ///< end to end
  double continuous_force_n = 0.0;  ///< of the device; 0: not known, no limit
  Vec3 workspace_half_size_m{0.0};  ///< box around the workspace's centre; 0: no limit along that axis
  double workspace_margin_m = 5e-3;      ///< beyond the box, over which the force fades out
  double fastest_m_per_s = 10.0;         ///< of the finger; a fast hand moves at 2 to 3
  double fastest_display_m_per_s = 1.0;  ///< of the roller; a drive reaches 0.2
  double stale_s = 10e-3;                ///< oldest sample that may produce a force
  double late_s = 20e-3;                 ///< longest tick
};

struct GateInput {
  Vec3 force_n{0.0};
  double display_m = 0.0;
  DeviceState force_device = DeviceState::absent;
  DeviceState display = DeviceState::absent;  ///< absent: none, which is no fault
  Vec3 position_m{0.0};                       ///< of the finger, as measured, world
  double position_age_s = 0.0;                ///< since it was measured
  double display_measured_m = 0.0;            ///< of the roller
  double display_age_s = 0.0;
  double display_travel_m = 0.0;  ///< as reported by the display, 0: not known; the smaller one limits
  double display_lowest_m = -1.0, display_highest_m = 1.0;  ///< requested range of targets, within the travel
  bool display_measures = false;                            ///< display_measured_m comes from a sensor
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
  explicit SafetyGate(const GateLimits& limits) : limits_(limits) {}

  /// Starts the ramp; also re-arms after a fault. Takes effect as soon as the force device is ready.
  void arm() noexcept;
  /// Disarms: no force from the next pass on.
  void stop() noexcept;
  /// Restarts the ramp if armed, and does not compare the next position with the last (the scene was replaced).
  void restart_ramp() noexcept;
  /// Centre of the device's workspace, world frame.
  void place_workspace(const Vec3& centre_m) noexcept { workspace_centre_m_ = centre_m; }

  /// Checks and limits one tick's output. Precondition: dt_s > 0. Failures show in the output's fault.
  GateOutput pass(const GateInput& input, double dt_s) noexcept;

  const GateLimits& limits() const { return limits_; }
  GateState state() const { return state_; }
  GateFault fault() const { return fault_; }
  /// Ticks in which each action was taken, by GateAction.
  const std::array<std::uint64_t, kGateActionCount>& counts() const { return counts_; }
  std::uint64_t faults() const { return faults_; }         ///< number of stops by a fault
  double shake_work_j() const { return shake_.work_j(); }  ///< see ShakeWatch

 private:
  bool live() const noexcept { return state_ == GateState::ramping || state_ == GateState::armed; }
  void latch(GateFault fault) noexcept;
  void latch_falling(GateFault fault) noexcept;
  void forget_motion() noexcept;
  bool check_finite(const GateInput& input, GateOutput& out) noexcept;
  void watch_devices(const GateInput& input) noexcept;
  void watch_freshness(const GateInput& input, double dt_s) noexcept;
  void watch_position(const GateInput& input, double dt_s) noexcept;
  void watch_roller(const GateInput& input, double dt_s) noexcept;
  Vec3 limit_force(const GateInput& input, double dt_s, GateOutput& out) noexcept;
  double workspace_share(const Vec3& position_m) const noexcept;
  double ramp_share(double dt_s) noexcept;
  void pass_display(const GateInput& input, GateOutput& out) noexcept;
  void note(GateAction action, GateOutput& out) noexcept;

  GateLimits limits_;
  GateState state_ = GateState::disarmed;
  GateFault fault_ = GateFault::none;
  bool force_was_ready_ = false, display_was_ready_ = false;  ///< since armed
  bool falling_ = false;                                      ///< one more pass at reduced force, then zero
  double since_armed_s_ = 0.0;
  Vec3 last_force_n_{0.0};
  double last_display_m_ = 0.0;
  Vec3 workspace_centre_m_{0.0};
  Vec3 last_position_m_{0.0};
  double last_roller_m_ = 0.0;
  bool position_known_ = false, roller_known_ = false;
  ForceBudget budget_;
  ShakeWatch shake_;
  FrozenPositionWatch frozen_;
  FrozenDisplayWatch display_frozen_;
  std::array<std::uint64_t, kGateActionCount> counts_{};
  std::uint64_t faults_ = 0;
};

}  // namespace tangent
