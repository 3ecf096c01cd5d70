// The simulated force device behind a scheduler of its own: it calls us at 1 kHz from its thread, as the drivers of
// some makers do. It shows that both ways into a tick work; the mechanics are those of the simulated one.
#pragma once

#include "devices/simulated/simulated_force_device.h"

#include <atomic>
#include <thread>

namespace tangent {

class ScheduledForceDevice final : public ForceDevice {
 public:
  explicit ScheduledForceDevice(const SimulatedForceOptions& options = {});
  ~ScheduledForceDevice() override { stop_calling(); }

  const ForceCapabilities& capabilities() const override { return capabilities_; }
  Status open() override { return device_.open(); }
  void close() override;
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override {
    return device_.exchange(command, dt_s);
  }
  SimulatedHand* hand() noexcept override { return device_.hand(); }
  bool inject(const FaultInjection& fault) noexcept override { return device_.inject(fault); }

  bool calls_us() const override { return true; }
  Status start_calling(const DeviceTick& tick) override;
  void stop_calling() override;

 private:
  void call(DeviceTick tick) noexcept;

  SimulatedForceDevice device_;
  ForceCapabilities capabilities_;
  std::atomic<bool> calling_{false};
  std::thread thread_;
};

}  // namespace tangent
