// How soon there is no force after a fault of the simulated force device: driver and gate, tick by tick.
#pragma once

#include "devices/device_safety.h"
#include "devices/safety_gate.h"
#include "devices/simulated/simulated_force_device.h"

#include <cmath>
#include <memory>

namespace tangent::testing {

struct SimulatedFaultTicks {
  int noticed = -1;  ///< until the gate or the device's own state says so; -1: never
  int zero = -1;     ///< until the exchange in which nothing is sent
};

/// A fault that is in what the driver gives, and not in the device.
enum class WrongSample { none, not_a_number, outside, backwards };
struct SimulatedFault {
  const char* name;
  InjectedFault injected = InjectedFault::none;
  DeviceFault device = DeviceFault::none;
  WrongSample sample = WrongSample::none;
  double stall_s = 0.0;  ///< of the tick
};

inline constexpr SimulatedFault kSimulatedFaults[] = {
    {"drop-out (unplugged)", InjectedFault::drop_out},       {"delay-burst (silence)", InjectedFault::delay_burst},
    {"stuck-encoder, moving", InjectedFault::stuck_encoder}, {"noise (garbage)", InjectedFault::noise},
    {"not a number", {}, {}, WrongSample::not_a_number},     {"outside its workspace", {}, {}, WrongSample::outside},
    {"time backwards", {}, {}, WrongSample::backwards},      {"stall of 30 ms", {}, {}, {}, 30e-3},
    {"its own fault: sensor", {}, DeviceFault::sensor},      {"its own fault: watchdog", {}, DeviceFault::watchdog},
};

/// 0.5 N are sent and the hand moves at 0.1 m/s when the fault comes.
inline SimulatedFaultTicks ticks_after(const SimulatedFault& fault) {
  constexpr double kTick_s = 1e-3, kSpeed_m_per_s = 0.1;
  constexpr int kBefore = 800, kMost = 200;
  SimulatedForceDevice device({.homing_s = 0.01});
  DeviceSet set;
  static_cast<void>(device.open());
  set.force = std::make_unique<SimulatedForceDevice>();
  SafetyGate gate(gate_limits(set, 1.0 / kTick_s));
  gate.arm();
  SimulatedFaultTicks ticks;
  DeviceRequest request = DeviceRequest::none;
  for (int tick = 0; tick < kBefore + kMost && ticks.zero < 0; ++tick) {
    const int since = tick - kBefore;
    const double dt_s = since == 0 && fault.stall_s > 0.0 ? fault.stall_s : kTick_s;
    device.lead(
        {.position_m = Vec3(0.0, 1e-4 * (tick - 400), 0.0), .velocity_m_per_s = Vec3(0.0, kSpeed_m_per_s, 0.0)});
    if (since == 0 && fault.injected != InjectedFault::none) device.inject({fault.injected, kMost});
    if (since == 0 && fault.device != DeviceFault::none) device.inject(fault.device);
    const Vec3 sent_n = gate.before_sending(dt_s);
    ForceSample sample = device.exchange({.force_n = sent_n, .request = request}, dt_s);
    request = sample.state == DeviceState::firmware ? DeviceRequest::home : DeviceRequest::none;
    if (since >= 0) {
      if (fault.sample == WrongSample::not_a_number) sample.position_m.x = std::nan("");
      if (fault.sample == WrongSample::outside) sample.position_m.x = 12.0;
      if (fault.sample == WrongSample::backwards) sample.age_s = -30e-3;
      if (sent_n == Vec3(0.0) || sample.state != DeviceState::ready) ticks.zero = since;
    }
    GateInput input;
    input.force_n = Vec3(0.5, 0.0, 0.0);
    input.force_device = sample.state;
    input.position_m = sample.position_m;
    input.position_age_s = sample.age_s;
    const GateOutput out = gate.pass(input, dt_s);
    if (since >= 0 && ticks.noticed < 0 && (out.state == GateState::faulted || sample.state != DeviceState::ready))
      ticks.noticed = since;
  }
  return ticks;
}

}  // namespace tangent::testing
