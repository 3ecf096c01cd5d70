// A contact location display (CLD): moves a roller along the fingerpad to the place of the contact.
// Talked to like a force device: one exchange a tick, command in, sample out.
#pragma once

#include "core/base/result.h"
#include "core/preset/preset.h"
#include "devices/device_state.h"
#include "devices/fault_injection.h"
#include "devices/link_report.h"

#include <cstdint>
#include <string>

namespace tangent {

/// What a contact display can do, as data. Zero: not known.
struct DisplayCapabilities {
  std::string name;
  bool simulated = false;
  double travel_m = 0.0;  ///< end to end; positions run from -travel/2 to +travel/2, positive distally
  double resolution_m = 0.0;
  double bandwidth_hz = 0.0;
  double rate_hz = 0.0;
  bool measures_position = true;    ///< false: open loop; samples tell where it was sent
  double firmware_timeout_s = 0.0;  ///< without a command its firmware stops the drive; 0: it has no time-out
  bool has_controller = false;      ///< it takes gains, speed and current: see set_controller
};

struct DisplayCommand {
  std::uint64_t tick = 0;
  double target_m = 0.0;  ///< ignored unless ready
  DeviceRequest request = DeviceRequest::none;
};

struct DisplaySample {
  double position_m = 0.0;  ///< of the roller, as measured
  double age_s = 0.0;       ///< since it was measured
  double travel_m = 0.0;    ///< end to end, as the device itself says; 0: as in the capabilities
  DeviceState state = DeviceState::absent;
  DeviceFault fault = DeviceFault::none;
};

class ContactDisplay {
 public:
  virtual ~ContactDisplay() = default;

  virtual const DisplayCapabilities& capabilities() const = 0;
  /// Not while another thread exchanges. Fails with what hinders it and what to do.
  virtual Status open() = 0;
  virtual void close() = 0;

  /// Called by the servo thread, once a tick; `dt_s` > 0. No allocation, lock, exception or log. Failures show in
  /// the sample's state.
  virtual DisplaySample exchange(const DisplayCommand& command, double dt_s) noexcept = 0;

  /// Gains and limits of its position loop, in force from the next exchange on. Servo thread. Passed over by a display
  /// that has no controller.
  virtual void set_controller(const ControllerSettings& settings) noexcept { static_cast<void>(settings); }

  /// Any thread. False: there is no cable to report on.
  virtual bool report(LinkReport& out) const {
    static_cast<void>(out);
    return false;
  }

  /// Pretends a fault, by name, from the next exchange on. False: a real device, which brings its own. Servo thread.
  virtual bool inject(const FaultInjection& fault) noexcept {
    static_cast<void>(fault);
    return false;
  }
};

}  // namespace tangent
