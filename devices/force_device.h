// A device that measures where the finger is and pushes on it.
//
// Once opened it is talked to by `exchange` alone: one call a tick, command in, sample out. The command is that of
// the tick before, so a force comes out one tick after the position it answers.
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"
#include "devices/device_state.h"
#include "devices/fault_injection.h"
#include "devices/link_report.h"

#include <cstdint>
#include <optional>
#include <string>

namespace tangent {

class SimulatedHand;

/// What a force device can do, as data. Zero: not known or not there.
struct ForceCapabilities {
  std::string name;  ///< for people: "simulated PHANToM-like"
  bool simulated = false;
  bool senses_orientation = false;
  double peak_force_n = 0.0;        ///< never to be exceeded
  double continuous_force_n = 0.0;  ///< can be held for ever
  double position_resolution_m = 0.0;
  double apparent_mass_kg = 0.0;
  double largest_stiffness_n_per_m = 0.0;
  Vec3 workspace_half_size_m{0.0};  ///< box around the origin
  double rate_hz = 0.0;             ///< of exchanges it is made for
  double firmware_timeout_s = 0.0;  ///< without a command its firmware stops the force; 0: it has no time-out
};

struct ForceCommand {
  std::uint64_t tick = 0;
  Vec3 force_n{0.0};  ///< world; ignored unless ready
  DeviceRequest request = DeviceRequest::none;
};

struct ForceSample {
  Vec3 position_m{0.0};                                 ///< finger centre, world, as the encoders read it
  Quat orientation{1.0, 0.0, 0.0, 0.0};                 ///< unit; finger frame -> world
  std::optional<Vec3> velocity_m_per_s = std::nullopt;  ///< of the finger, world, where the device measures it itself
  double age_s = 0.0;                                   ///< of position and orientation: since they were measured
  Vec3 force_n{0.0};                                    ///< rendered during the exchange; zero outside ready
  DeviceState state = DeviceState::absent;
  DeviceFault fault = DeviceFault::none;
};

class ForceDevice {
 public:
  virtual ~ForceDevice() = default;

  virtual const ForceCapabilities& capabilities() const = 0;
  /// Not while another thread exchanges. Fails with what hinders it and what to do.
  virtual Status open() = 0;
  virtual void close() = 0;

  /// Called by the servo thread, once a tick; `dt_s` since the last one, > 0. No allocation, lock, exception or
  /// log. Failures show in the sample's state.
  virtual ForceSample exchange(const ForceCommand& command, double dt_s) noexcept = 0;

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

  /// The simulated hand that holds the device; null for a real one, whose hand needs no leading.
  virtual SimulatedHand* hand() noexcept { return nullptr; }
};

}  // namespace tangent
