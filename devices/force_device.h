// A force device: measures the finger's position and applies a force to it.
//
// Once it is open, `exchange` is the only call: once per tick, command in, sample out. The command is that of the
// previous tick, so a force is applied one tick after the position it responds to. open_devices (device_safety.h) opens
// it and refuses capabilities that make no sense.
//
// Who keeps the time: with most devices the caller, who calls `exchange` by a clock. The drivers of some makers have a
// scheduler of their own instead and call us (`calls_us`): they are given the tick (`start_calling`), which then calls
// `exchange` from within.
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"
#include "devices/device_state.h"
#include "devices/fault_injection.h"
#include "devices/link_report.h"
#include "devices/placement.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace tangent {

class SimulatedHand;

/// Capabilities of a force device. Zero: not known or not present.
struct ForceCapabilities {
  std::string name;         ///< for people: "simulated PHANToM-like"
  std::string serial = {};  ///< empty: not known
  bool simulated = false;
  std::array<bool, 3> pushes_along{true, true, true};  ///< axes of its own frame; along the others no force is sent
  /// Rotations of the finger that it measures: roll about the finger's own length, tilt up and down, turn to the side.
  /// In those that it doesn't, the finger points forward as it does by default; without any the device's orientation is
  /// not read.
  std::array<bool, 3> senses_rotation{false, false, false};
  int rotations_sensed() const { return int{senses_rotation[0]} + int{senses_rotation[1]} + int{senses_rotation[2]}; }
  int buttons = 0;                  ///< on its handle, 32 at most
  double peak_force_n = 0.0;        ///< must never be exceeded
  double continuous_force_n = 0.0;  ///< can be held indefinitely
  double position_resolution_m = 0.0;
  double apparent_mass_kg = 0.0;
  double largest_stiffness_n_per_m = 0.0;  ///< that it renders stably
  double largest_damping_n_s_per_m = 0.0;  ///< that it renders stably
  Vec3 workspace_half_size_m{0.0};         ///< box around its origin
  DeviceFrame frame = {};                  ///< its own axes and origin in the world
  double rate_hz = 0.0;                    ///< exchanges per second it is designed for
  double homing_s = 10.0;                  ///< homing takes no longer; 0: it is homed by hand
  double firmware_timeout_s = 0.0;         ///< firmware watchdog: stops the force when no command comes; 0: none
};

/// "x, y, z": the axes that it can push along.
std::string pushed_axes(const ForceCapabilities& can);
/// "roll, tilt, turn", "tilt" or "none": the rotations of the finger that it measures.
std::string sensed_rotations(const ForceCapabilities& can);
/// What a device that measures these rotations alone gives of an orientation (unit): a turn about z after a tilt about
/// y after a roll about x, without the others. All three: the same bits.
Quat as_sensed(const Quat& orientation, const std::array<bool, 3>& senses_rotation) noexcept;
/// "at 0.0 0.0 300.0 mm, turned by 0.0 0.0 90.0 deg": in the world.
std::string frame_text(const DeviceFrame& frame);

struct ForceCommand {
  std::uint64_t tick = 0;
  Vec3 force_n{0.0};  ///< the device's frame; ignored unless ready
  DeviceRequest request = DeviceRequest::none;
};

/// In the device's frame.
struct ForceSample {
  Vec3 position_m{0.0};                                 ///< finger centre, as the encoders read it
  Quat orientation{1.0, 0.0, 0.0, 0.0};                 ///< unit; finger frame -> device frame
  std::optional<Vec3> velocity_m_per_s = std::nullopt;  ///< of the finger, where the device measures it itself
  double age_s = 0.0;                                   ///< of position and orientation: since they were measured
  Vec3 force_n{0.0};                                    ///< rendered during the exchange; zero outside ready
  DeviceState state = DeviceState::absent;
  DeviceFault fault = DeviceFault::none;
  std::uint32_t buttons = 0;  ///< pressed: bit per button, the first is 1
};

/// A tick for a driver to call, from a thread of its own.
struct DeviceTick {
  void (*run)(void* context) noexcept = nullptr;
  void* context = nullptr;
};

class ForceDevice {
 public:
  virtual ~ForceDevice() = default;

  /// Any thread; constant for the lifetime of the device.
  virtual const ForceCapabilities& capabilities() const = 0;
  /// Not while another thread calls exchange. Fails with the cause and what to do about it.
  virtual Status open() = 0;
  /// Stops the force and releases the device; may block. Not while another thread calls exchange.
  virtual void close() = 0;

  /// Called by the servo thread once per tick. `dt_s`: seconds since the last exchange, > 0. Does not allocate, lock,
  /// throw or log. Failures show in the sample's state and fault.
  virtual ForceSample exchange(const ForceCommand& command, double dt_s) noexcept = 0;

  /// Any thread, also while an exchange does not return: stops the force by a way of its own, as another transfer or a
  /// closed handle. False when the device has none. Does not wait.
  virtual bool emergency_stop() noexcept { return false; }

  /// Whether the driver keeps the time: see above. Constant.
  virtual bool calls_us() const { return false; }
  /// Calls `tick` at capabilities().rate_hz, never two at once, until stop_calling has returned. After open; exchange
  /// is then called by the tick alone. Fails when the driver's scheduler can't be started.
  virtual Status start_calling(const DeviceTick& tick) {
    static_cast<void>(tick);
    return fail("this device keeps no time of its own", capabilities().name, "call exchange by a clock");
  }
  /// Returns after the last call. Not from within a tick.
  virtual void stop_calling() {}

  /// Any thread. False, and `out` unchanged, when the device has no USB link to report on.
  virtual bool report(LinkReport& out) const {
    static_cast<void>(out);
    return false;
  }

  /// Simulates a fault from the next exchange on. Servo thread. False for a real device, which can't.
  virtual bool inject(const FaultInjection& fault) noexcept {
    static_cast<void>(fault);
    return false;
  }

  /// The simulated hand that holds the device; null for a real device. Servo thread.
  virtual SimulatedHand* hand() noexcept { return nullptr; }
};

}  // namespace tangent
