// Simulated contact display: a roller driven by a motor under a PID, with travel stops and a quantised encoder. Default
// values are those of the paper's CLD.
//
// Pure computation: no clock, no thread. The same commands and time steps give identical results.
#pragma once

#include "devices/contact_display.h"
#include "devices/simulated/cld_mechanism.h"
#include "devices/simulated/simulated_life.h"

#include <array>
#include <random>

namespace tangent {

struct SimulatedDisplayOptions {
  CldMechanismOptions mechanism;
  double homing_s = 0.25;
  std::uint64_t seed = 1;  ///< of injected noise
};

class SimulatedContactDisplay final : public ContactDisplay {
 public:
  explicit SimulatedContactDisplay(const SimulatedDisplayOptions& options = {});

  const DisplayCapabilities& capabilities() const override { return capabilities_; }
  Status open() override { return life_.open(capabilities_.name); }
  void close() override { life_.close(); }
  /// The PID runs at 1 kHz whatever dt_s is: once for each whole millisecond that has passed.
  DisplaySample exchange(const DisplayCommand& command, double dt_s) noexcept override;
  void set_controller(const ControllerSettings& settings) noexcept override;
  bool inject(const FaultInjection& fault) noexcept override {
    life_.inject(fault);
    return true;
  }

  /// Puts the device into this fault at the next exchange. Same thread as exchange.
  void inject(DeviceFault fault) noexcept { life_.inject(fault); }
  const CldMechanism& mechanism() const { return mechanism_; }

 private:
  DisplaySample measure(double dt_s) noexcept;

  SimulatedDisplayOptions options_;
  DisplayCapabilities capabilities_;
  SimulatedLife life_;
  std::mt19937_64 random_;
  double since_control_s_ = 0.0;
  double shown_m_ = 0.0, age_s_ = 0.0;
  CldMechanism mechanism_;
};

}  // namespace tangent
