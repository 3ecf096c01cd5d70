// A contact display that isn't there: a roller that follows its target with a second-order lag between two stops,
// in steps. Figures of the paper's CLD.
//
// Pure computation: no clock, no thread. The same commands and time steps give the same bits.
#pragma once

#include "devices/contact_display.h"

namespace tangent {

struct SimulatedDisplayOptions {
  double travel_m = 20e-3;
  double bandwidth_hz = 12.0;      ///< -3 dB. The paper's: over 5 Hz
  double step_m = 0.8e-6;          ///< of drive and encoder; 0: exact
  double homing_s = 0.25;
};

class SimulatedContactDisplay final : public ContactDisplay {
 public:
  explicit SimulatedContactDisplay(const SimulatedDisplayOptions& options = {});

  const DisplayCapabilities& capabilities() const override { return capabilities_; }
  Status open() override;
  void close() override;
  DisplaySample exchange(const DisplayCommand& command, double dt_s) noexcept override;

  /// The next exchange finds the device in this fault. Same thread as exchange.
  void inject(DeviceFault fault) noexcept { injected_ = fault; }
  double exact_position_m() const { return position_; }   ///< before the encoder

 private:
  void update_state(const DisplayCommand& command, double dt_s) noexcept;
  void follow(double target, double dt_s) noexcept;

  SimulatedDisplayOptions options_;
  DisplayCapabilities capabilities_;
  DeviceStateMachine machine_;
  DeviceFault injected_ = DeviceFault::none;
  double homing_for_s_ = 0.0;
  double position_ = 0.0, velocity_ = 0.0;
};

}  // namespace tangent
