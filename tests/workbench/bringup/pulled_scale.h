// A simulated force device whose motors have a torque scale of their own, as a Falcon that nobody calibrated, and a
// person who hooks a spring scale to it.
#pragma once

#include "devices/falcon/falcon_driver.h"
#include "devices/simulated/simulated_force_device.h"
#include "workbench/bringup/force_calibration.h"
#include "workbench/bringup/guided_hand.h"

#include <cmath>
#include <functional>
#include <limits>

namespace tangent::testing {

struct PulledDeviceFaults {
  double from_s = -1.0;  ///< from this time on, one of:
  bool not_a_number = false, unplugged = false, silent = false;
};

/// Counts for `used` act as torques of `truth` counts for 1 N m.
class PulledDevice final : public ForceDevice {
 public:
  PulledDevice(double used, double truth, const PulledDeviceFaults& faults = {})
      : used_(used), truth_(truth), faults_(faults), device_({.seed = 3}), capabilities_(falcon_capabilities({})) {
    capabilities_.simulated = true;
    capabilities_.serial = "77";
  }
  const ForceCapabilities& capabilities() const override { return capabilities_; }
  Status open() override { return device_.open(); }
  void close() override { device_.close(); }
  SimulatedHand* hand() noexcept override { return &device_; }
  /// That the motors make.
  const Vec3& true_force_n() const { return true_n_; }

  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override {
    t_s_ += dt_s;
    double share = 0.0;
    const Vec3 place_m = device_.exact_position_m();
    const auto counts = falcon_counts(place_m, command.force_n, used_, kFalconUncalibratedCounts, share);
    Vec3 torques(0.0);
    for (int i = 0; i < 3; ++i) torques[i] = -counts[static_cast<std::size_t>(i)] / truth_;
    ForceCommand pushed = command;
    pushed.force_n = falcon_force(place_m + kFalconCentre_m, torques).value_or(Vec3(0.0));
    ForceSample sample = device_.exchange(pushed, dt_s);
    true_n_ = sample.state == DeviceState::ready ? pushed.force_n : Vec3(0.0);
    sample.force_n = sample.state == DeviceState::ready ? share * command.force_n : Vec3(0.0);
    if (faults_.from_s < 0.0 || t_s_ < faults_.from_s) return sample;
    if (faults_.not_a_number) sample.position_m.y = std::numeric_limits<double>::quiet_NaN();
    if (faults_.unplugged) sample.state = DeviceState::absent;
    if (faults_.silent) sample.age_s = t_s_ - faults_.from_s;
    return sample;
  }

 private:
  double used_, truth_;
  PulledDeviceFaults faults_;
  SimulatedForceDevice device_;
  ForceCapabilities capabilities_;
  Vec3 true_n_{0.0};
  double t_s_ = 0.0;
};

struct CalibrationRun {
  CalibrationView view;
  std::uint64_t ticks = 0, ticks_to_zero = 0;  ///< exchanges with force after it had ended
  double largest_n = 0.0, unasked_n = 0.0;     ///< by the motors; before the first pull was said yes to
};

/// `reads`: what the person reads of a true force, in N, at the reading of that number.
using ReadsScale = std::function<double(double true_n, std::size_t reading)>;

/// A spring scale with marks at each 0.01 N.
inline double spring_scale(double true_n, std::size_t) { return std::round(true_n * 100.0) / 100.0; }

/// Until it ends; `stop_at`: a stop at this tick.
inline CalibrationRun calibrate(PulledDevice& device, const ReadsScale& reads = spring_scale,
                                std::uint64_t stop_at = 0) {
  constexpr std::uint64_t kMostTicks = 100'000;
  CalibrationRun run;
  static_cast<void>(device.open());
  ForceCalibration machine(device, {});
  GuidedHand hand(device.hand());
  bool asked_pull = false;
  while (run.ticks < kMostTicks && !machine.view().ended) {
    const CalibrationView& view = machine.view();
    hand.follow(view, 1e-3);
    if (++run.ticks == stop_at) machine.stop();
    machine.tick(1e-3);
    const double now_n = glm::length(device.true_force_n());
    run.largest_n = std::max(run.largest_n, now_n);
    if (!asked_pull) run.unasked_n = std::max(run.unasked_n, now_n);
    if (!view.asks() || !hand.settled(view)) continue;
    asked_pull = asked_pull || view.ask == CalibrationAsk::pull;
    const double read_n = view.ask == CalibrationAsk::reading ? reads(now_n, view.reading_count) : 0.0;
    machine.answer({BringUpAnswer::yes, read_n}, view.questions);
  }
  run.view = machine.view();
  for (int i = 0; i < 20; ++i) {
    machine.tick(1e-3);
    if (device.true_force_n() != Vec3(0.0)) ++run.ticks_to_zero;
  }
  device.close();
  return run;
}

}  // namespace tangent::testing
