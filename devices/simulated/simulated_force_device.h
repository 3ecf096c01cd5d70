// Simulated force device: a mass held by a spring-damper hand and pushed by the commanded force. Default values are
// those of the PHANToM Premium 1.5 unless stated otherwise. SI units, its own frame.
//
// Pure computation: no clock, no thread. The same seed, targets, commands and time steps give identical results.
//
//   m x'' = k (g - x) + b (g' - x') + F - friction,   g: the hand's target, moving at its velocity, plus tremor
#pragma once

#include "devices/force_device.h"
#include "devices/simulated/simulated_life.h"
#include "devices/simulated_hand.h"

#include <cstdint>
#include <random>

namespace tangent {

struct SimulatedForceOptions {
  std::uint64_t seed = 1;
  double device_mass_kg = 0.075;  ///< apparent
  double hand_mass_kg = 0.1;      ///< moving mass of finger and hand
  double hand_stiffness_n_per_m = 400.0;
  double hand_damping_n_s_per_m = 12.0;                   ///< about half critical with a contact of 400 N/m
  double tremor_m = 10e-6;                                ///< RMS along each axis, around 9 Hz; 0: none
  double position_step_m = 0.03e-3;                       ///< of the encoders; 0: exact
  bool measures_velocity = false;                         ///< by a tachometer of its own; a Premium has none
  std::array<bool, 3> senses_rotation{true, true, true};  ///< roll, tilt, turn of the finger
  double friction_n = 0.04;                               ///< of the drives, dry; 0: none
  double homing_s = 0.1;
  int substeps = 4;  ///< integration steps per exchange
};

class SimulatedForceDevice final : public ForceDevice, public SimulatedHand {
 public:
  explicit SimulatedForceDevice(const SimulatedForceOptions& options = {});

  const ForceCapabilities& capabilities() const override { return capabilities_; }
  Status open() override { return life_.open(capabilities_.name); }
  void close() override { life_.close(); }
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override;
  SimulatedHand* hand() noexcept override { return this; }

  void lead(const HandTarget& target) noexcept override { target_ = target; }
  void place(const HandTarget& target) noexcept override;

  bool inject(const FaultInjection& fault) noexcept override {
    life_.inject(fault);
    return true;
  }
  /// Puts the device into this fault at the next exchange. Same thread as exchange.
  void inject(DeviceFault fault) noexcept { life_.inject(fault); }

  const Vec3& exact_position_m() const { return position_; }  ///< before quantisation by the encoders
  const Vec3& velocity_m_per_s() const { return velocity_; }

 private:
  void update_tremor(double dt_s) noexcept;
  void integrate(const Vec3& force, double dt_s) noexcept;
  ForceSample measure(const Vec3& force, double dt_s) noexcept;

  SimulatedForceOptions options_;
  ForceCapabilities capabilities_;
  SimulatedLife life_;
  HandTarget target_;
  Vec3 position_{0.0}, velocity_{0.0};
  Vec3 shown_{0.0};     ///< last encoder reading
  double age_s_ = 0.0;  ///< time since that reading
  Vec3 tremor_{0.0}, tremor_velocity_{0.0};
  std::mt19937_64 random_;
};

}  // namespace tangent
