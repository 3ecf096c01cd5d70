// The one place between what a tick computes and what the devices are told.
//
// Force and display targets pass through here and nowhere else, simulated devices included: finite check, clamp to
// the device's peak force, slew limit, ramp-in after arming, and a fault that stays until a person re-arms. Plain
// state and arithmetic: no clock, no allocation, no lock.
#pragma once

#include "core/base/vec.h"
#include "devices/device_state.h"

#include <array>
#include <cstdint>

namespace tangent {

enum class GateState : std::uint8_t {
  disarmed,  ///< no force
  ramping,   ///< armed, force growing in
  armed,
  faulted,   ///< no force until re-armed
};

enum class GateFault : std::uint8_t {
  none,
  force_not_finite,
  display_not_finite,
  force_device,     ///< left ready while armed
  contact_display,  ///< left ready while armed
};

/// What the gate did to a tick's output.
enum class GateAction : std::uint8_t {
  force_clamped,      ///< above the device's peak force
  slew_limited,       ///< changed faster than allowed
  ramped_in,          ///< reduced, since armed a moment ago
  display_clamped,    ///< beyond the display's travel
  refused_not_finite, ///< zero sent instead
  withheld,           ///< a force was asked for while disarmed, faulted or not yet ready
  count_
};
inline constexpr std::size_t kGateActionCount = static_cast<std::size_t>(GateAction::count_);

const char* to_string(GateState state);
const char* to_string(GateFault fault);
const char* to_string(GateAction action);

struct GateLimits {
  double peak_force_n = 0.0;          ///< of the device; 0: no force at all
  double slew_n_per_s = 2000.0;       ///< fastest change of the force; the fall to zero of a stop or fault is not held back
  double ramp_s = 0.25;               ///< from arming to full force
  double display_travel_m = 0.0;      ///< end to end
};

struct GateInput {
  Vec3 force_n{0.0};
  double display_m = 0.0;
  DeviceState force_device = DeviceState::absent;
  DeviceState display = DeviceState::absent;   ///< absent: there is none, which is no fault
};

struct GateOutput {
  Vec3 force_n{0.0};
  double display_m = 0.0;
  GateState state = GateState::disarmed;
  GateFault fault = GateFault::none;
  std::uint8_t actions = 0;           ///< bit per GateAction
  bool did(GateAction action) const { return (actions >> static_cast<unsigned>(action)) & 1u; }
};

class SafetyGate {
 public:
  explicit SafetyGate(const GateLimits& limits) : limits_(limits) {}

  /// Starts the ramp; also re-arms after a fault. Takes effect as soon as the force device is ready.
  void arm() noexcept;
  /// No force from the next pass on.
  void stop() noexcept;
  /// Begins the ramp anew if armed (the scene under the finger was replaced).
  void restart_ramp() noexcept;

  /// Precondition: dt_s > 0.
  GateOutput pass(const GateInput& input, double dt_s) noexcept;

  const GateLimits& limits() const { return limits_; }
  GateState state() const { return state_; }
  GateFault fault() const { return fault_; }
  const std::array<std::uint64_t, kGateActionCount>& counts() const { return counts_; }
  std::uint64_t faults() const { return faults_; }

 private:
  void latch(GateFault fault) noexcept;
  void watch_devices(const GateInput& input) noexcept;
  Vec3 limit_force(const Vec3& wanted, double dt_s, GateOutput& out) noexcept;
  void note(GateAction action, GateOutput& out) noexcept;

  GateLimits limits_;
  GateState state_ = GateState::disarmed;
  GateFault fault_ = GateFault::none;
  bool force_was_ready_ = false, display_was_ready_ = false;  ///< since armed
  double since_armed_s_ = 0.0;
  Vec3 last_force_n_{0.0};
  double last_display_m_ = 0.0;
  std::array<std::uint64_t, kGateActionCount> counts_{};
  std::uint64_t faults_ = 0;
};

}  // namespace tangent
