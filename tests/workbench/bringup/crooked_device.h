// A simulated force device whose driver has a fault: for bring-up.
#pragma once

#include "devices/simulated/simulated_force_device.h"

#include <cstdint>
#include <limits>
#include <string>

namespace tangent::testing {

struct Crookedness {
  glm::dmat3 reads{1.0};     ///< what the encoders give of a true position
  glm::dmat3 pushes{1.0};    ///< what the motors make of a command
  double noise_m = 0.0;      ///< RMS of each reading
  bool says_larger = false;  ///< reports twice the force
  bool keeps_force = false;  ///< zero does not take a force away
  bool never_opens = false, never_identified = false, never_homes = false;
  int late_every = 0;    ///< each so many exchanges gives no new sample for 3 ms
  double old_s = 0.0;    ///< age of every sample
  int back_every = 0;    ///< each so many exchanges gives a sample of 30 ms ago
  double from_s = -1.0;  ///< from this time on, one of:
  bool not_a_number = false, far_outside = false, unplugged = false, silent = false;
  double timeout_s = 0.0;     ///< firmware time-out that it says it has,
  bool timeout_works = true;  ///< and has
  bool has_emergency_stop = false, emergency_stop_works = true;
  bool loses_zero = false;  ///< when its time-out is over
  DeviceFrame frame{};      ///< that it says it has
  std::array<bool, 3> pushes_along{true, true, true};
};

class CrookedDevice final : public ForceDevice {
 public:
  explicit CrookedDevice(const Crookedness& faults, std::uint64_t seed = 1)
      : faults_(faults), device_({.seed = seed}), capabilities_(device_.capabilities()) {
    capabilities_.serial = "77";
    capabilities_.firmware_timeout_s = faults.timeout_s;
    capabilities_.frame = faults.frame;
    capabilities_.pushes_along = faults.pushes_along;
  }
  const ForceCapabilities& capabilities() const override { return capabilities_; }
  Status open() override { return faults_.never_opens ? Status{} : device_.open(); }
  void close() override { device_.close(); }
  SimulatedHand* hand() noexcept override { return &device_; }
  const Vec3& true_position_m() const { return device_.exact_position_m(); }
  const Vec3& true_force_n() const { return pushed_n_; }
  int homes() const { return homes_; }  ///< that it was asked for

  bool emergency_stop() noexcept override {
    stopped_ = faults_.has_emergency_stop && faults_.emergency_stop_works;
    return faults_.has_emergency_stop;
  }

  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override {
    t_s_ += dt_s;
    ++exchanges_;
    ForceCommand turned = command;
    if (faults_.never_homes && command.request == DeviceRequest::home) turned.request = DeviceRequest::none;
    if (command.request == DeviceRequest::home) stopped_ = false, ++homes_;
    turned.force_n = faults_.pushes * command.force_n;
    if (faults_.keeps_force && command.force_n == Vec3(0.0)) turned.force_n = pushed_n_;
    if (stopped_) turned.force_n = Vec3(0.0);
    const ForceSample sample = faults_.timeout_works && faults_.timeout_s > 0.0 && dt_s > faults_.timeout_s
                                   ? pass_silence(turned, dt_s)
                                   : step(turned, dt_s);
    return crooked(sample, command);
  }

 private:
  /// The last force acts all the while, until the firmware's time is over.
  ForceSample pass_silence(const ForceCommand& command, double dt_s) noexcept {
    ForceCommand now = command;
    now.force_n = Vec3(0.0);
    ForceSample sample;
    for (double t_s = 0.0; t_s < dt_s; t_s += 1e-3) sample = step(now, 1e-3);
    if (faults_.loses_zero) device_.inject(DeviceFault::watchdog);
    return sample;
  }
  ForceSample step(const ForceCommand& command, double dt_s) noexcept {
    if (dt_s > 5e-3) {  // a time-out that does not work
      ForceCommand held = command;
      held.force_n = pushed_n_;
      ForceSample sample;
      for (double t_s = 0.0; t_s < dt_s; t_s += 1e-3) sample = device_.exchange(held, 1e-3);
      pushed_n_ = command.force_n;
      return sample;
    }
    const ForceSample sample = device_.exchange(command, dt_s);
    pushed_n_ = sample.state == DeviceState::ready ? command.force_n : Vec3(0.0);
    return sample;
  }

  ForceSample crooked(ForceSample sample, const ForceCommand& command) noexcept {
    if (faults_.never_opens) sample.state = DeviceState::absent;
    if (faults_.never_identified && sample.state == DeviceState::firmware) sample.state = DeviceState::open;
    sample.position_m = faults_.reads * sample.position_m;
    for (int i = 0; i < 3; ++i) sample.position_m[i] += faults_.noise_m * std::sqrt(3.0) * (2.0 * random() - 1.0);
    sample.force_n = (faults_.says_larger ? 2.0 : 1.0) * command.force_n;
    sample.age_s = faults_.old_s;
    if (faults_.late_every > 0 && exchanges_ % static_cast<std::uint64_t>(faults_.late_every) < 3)
      sample.age_s += 1e-3 * static_cast<double>(exchanges_ % static_cast<std::uint64_t>(faults_.late_every) + 1);
    if (faults_.back_every > 0 && exchanges_ % static_cast<std::uint64_t>(faults_.back_every) == 0)
      sample.age_s += 30e-3;
    if (faults_.from_s < 0.0 || t_s_ < faults_.from_s) return sample;
    if (faults_.not_a_number) sample.position_m.y = std::numeric_limits<double>::quiet_NaN();
    if (faults_.far_outside) sample.position_m.x = 12.0;
    if (faults_.unplugged) sample.state = DeviceState::absent;
    if (faults_.silent) sample.age_s = t_s_ - faults_.from_s;
    return sample;
  }
  double random() noexcept {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

  Crookedness faults_;
  SimulatedForceDevice device_;
  ForceCapabilities capabilities_;
  Vec3 pushed_n_{0.0};
  double t_s_ = 0.0;
  std::uint64_t exchanges_ = 0, state_ = 7;
  int homes_ = 0;
  bool stopped_ = false;
};

}  // namespace tangent::testing
