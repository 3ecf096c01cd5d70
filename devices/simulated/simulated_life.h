// State machine shared by the simulated devices: opening, homing for a while, requests, injected faults. Not
// thread-safe: same thread as exchange.
#pragma once

#include "core/base/result.h"
#include "devices/device_state.h"
#include "devices/fault_injection.h"

#include <string>

namespace tangent {

class SimulatedLife {
 public:
  explicit SimulatedLife(double homing_s) : homing_s_(homing_s) {}

  /// Fails when already open; `name` is the device's, for the message.
  Status open(const std::string& name);
  void close() { machine_.enter(DeviceState::absent); }
  void inject(const FaultInjection& fault) noexcept { timer_.begin(fault); }
  void inject(DeviceFault fault) noexcept { next_fault_ = fault; }

  /// Call once per exchange, before the device is integrated. `finite`: whether the command's value is finite.
  void update(DeviceRequest request, bool finite, double dt_s) noexcept;

  DeviceState state() const { return machine_.state(); }
  DeviceFault fault() const { return machine_.fault(); }
  bool ready() const { return machine_.ready(); }
  InjectedFault injected() const { return injected_; }  ///< in this exchange

 private:
  DeviceStateMachine machine_;
  DeviceFault next_fault_ = DeviceFault::none;
  InjectedFaultTimer timer_;
  InjectedFault injected_ = InjectedFault::none;
  double homing_s_ = 0.0, homing_for_s_ = 0.0;
};

}  // namespace tangent
