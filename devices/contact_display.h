// A contact location display (CLD): moves a roller along the fingerpad to the contact's place.
// Used like a force device: one exchange per tick, command in, sample out. SI units.
#pragma once

#include "core/base/result.h"
#include "core/preset/preset.h"
#include "devices/device_state.h"
#include "devices/fault_injection.h"
#include "devices/link_report.h"

#include <cstdint>
#include <string>

namespace tangent {

/// Capabilities of a contact display. Zero: not known.
struct DisplayCapabilities {
  std::string name;
  bool simulated = false;
  double travel_m = 0.0;  ///< end to end; positions run from -travel/2 to +travel/2, positive distally
  double resolution_m = 0.0;
  double bandwidth_hz = 0.0;
  double rate_hz = 0.0;
  double fastest_m_per_s = 0.0;     ///< of the target
  bool measures_position = true;    ///< false: open loop; samples repeat the last command
  double homing_s = 10.0;           ///< homing takes no longer; 0: it is homed by hand
  double firmware_timeout_s = 0.0;  ///< firmware watchdog: stops the drive when no command comes; 0: none
  bool has_controller = false;      ///< takes gains, speed and current: see set_controller
};

struct DisplayCommand {
  std::uint64_t tick = 0;
  double target_m = 0.0;  ///< roller position on the fingerpad, positive distally; ignored unless ready
  DeviceRequest request = DeviceRequest::none;
};

struct DisplaySample {
  double position_m = 0.0;  ///< of the roller, as measured
  double age_s = 0.0;       ///< since it was measured
  double travel_m = 0.0;    ///< end to end, as reported by the device; 0: as in the capabilities
  DeviceState state = DeviceState::absent;
  DeviceFault fault = DeviceFault::none;
};

class ContactDisplay {
 public:
  virtual ~ContactDisplay() = default;

  /// Any thread; constant for the lifetime of the device.
  virtual const DisplayCapabilities& capabilities() const = 0;
  /// Not while another thread calls exchange. Fails with the cause and what to do about it.
  virtual Status open() = 0;
  /// Stops the drive and releases the device; may block. Not while another thread calls exchange.
  virtual void close() = 0;

  /// Called by the servo thread once per tick. `dt_s`: seconds since the last exchange, > 0. Does not allocate, lock,
  /// throw or log. Failures show in the sample's state and fault.
  virtual DisplaySample exchange(const DisplayCommand& command, double dt_s) noexcept = 0;

  /// Sets gains and limits of the position loop from the next exchange on. Servo thread. A display without a controller
  /// ignores it.
  virtual void set_controller(const ControllerSettings& settings) noexcept { static_cast<void>(settings); }

  /// Any thread, also while an exchange does not return: stops the drive by a way of its own. False when the device has
  /// none. Does not wait.
  virtual bool emergency_stop() noexcept { return false; }

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
};

}  // namespace tangent
