// A simulated hand on one stimulus, closed loop: it is led somewhere, the device measures where it got to, a tick
// renders what is there, and the force of that tick pushes it in the next. Deterministic.
#pragma once

#include "core/tick/step.h"
#include "devices/simulated/simulated_force_device.h"

#include <memory>

namespace tangent::experiment {

inline constexpr double kTouchTick_s = 1e-3;

class SimulatedTouch {
 public:
  /// `turn`: from the device's orientation to the scene's. Places are the scene's.
  SimulatedTouch(std::shared_ptr<const ContactScene> scene, const Preset& preset, std::uint64_t seed,
                 const Quat& turn = Quat(1.0, 0.0, 0.0, 0.0));
  /// Homes the device there. Fails as the device does.
  Status begin(const HandTarget& at);
  TickOutput tick(const HandTarget& target);
  double seconds() const { return t_s_; }

 private:
  Preset preset_;
  Stepper stepper_;
  SimulatedForceDevice device_;
  Quat turn_;
  TickState state_;
  Vec3 force_n_{0.0};
  double t_s_ = 0.0;
};

}  // namespace tangent::experiment
