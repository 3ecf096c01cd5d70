// A simulated force device whose finger goes where a test says: the program sees a device that it does not lead, as it
// sees a real one.
#pragma once

#include "devices/simulated/simulated_force_device.h"

#include <memory>

namespace tangent::test {

/// What the test and the device share.
struct FingerScript {
  Vec3 target_m{0.0};  ///< of the hand's spring, the device's frame; gone to at no more than fastest_m_per_s
  double fastest_m_per_s = 0.5;
  DeviceFault fault = DeviceFault::none;  ///< put in once
  bool real = false;                      ///< says that it is no simulated device
  bool absent = false;                    ///< not plugged in
};

class ScriptedFinger final : public ForceDevice {
 public:
  explicit ScriptedFinger(std::shared_ptr<FingerScript> script) : script_(std::move(script)) {
    device_.place({script_->target_m});
    at_ = script_->target_m;
    capabilities_ = device_.capabilities();
    capabilities_.simulated = !script_->real;
  }
  const ForceCapabilities& capabilities() const override { return capabilities_; }
  Status open() override { return device_.open(); }
  void close() override { device_.close(); }
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override {
    const Vec3 way = script_->target_m - at_;
    const double far_m = glm::length(way), most_m = script_->fastest_m_per_s * dt_s;
    const Vec3 move = far_m > most_m ? way * (most_m / far_m) : way;
    device_.lead({at_, move / dt_s});
    at_ += move;
    if (script_->fault != DeviceFault::none) device_.inject(std::exchange(script_->fault, DeviceFault::none));
    ForceSample sample = device_.exchange(command, dt_s);
    if (script_->absent) sample.state = DeviceState::absent;
    return sample;
  }

 private:
  std::shared_ptr<FingerScript> script_;
  SimulatedForceDevice device_;
  ForceCapabilities capabilities_;
  Vec3 at_{0.0};
};

}  // namespace tangent::test
