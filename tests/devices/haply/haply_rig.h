// Driver and safety gate over the emulated service, a tick at a time, by a clock that only ticks move: a slow machine
// changes nothing.
#pragma once

#include "devices/device_safety.h"
#include "devices/haply/haply_device.h"
#include "devices/safety_gate.h"
#include "tests/devices/haply/haply_service.h"
#include "tests/devices/usb/usb_checks.h"

#include <atomic>
#include <memory>

namespace tangent::testing {

/// Milliseconds of the only clock that a rig's samples are aged by.
inline std::atomic<std::int64_t> g_haply_ms{1};
inline std::int64_t haply_test_clock() noexcept { return g_haply_ms * 1'000'000; }

/// For tests that step the ticks themselves: times of the machine's clock are out of the way.
inline HaplyOptions stepped_haply(const HaplyService& service) {
  HaplyOptions options;
  options.address = service.address();
  options.connect_s = 60.0;
  options.retry_s = 0.01;
  options.events_port = 0;
  options.our_stall_s = 1e6;
  options.clock = haply_test_clock;
  return options;
}

struct HaplyRig {
  HaplyService& service;
  DeviceSet devices;
  HaplyForceDevice& device;
  SafetyGate gate;
  ForceSample sample;
  GateOutput out;
  Vec3 wanted_n{0.0, 0.0, 1.0};
  double stiffness_n_per_m = 1000.0;

  explicit HaplyRig(HaplyService& s) : HaplyRig(s, stepped_haply(s)) {}
  HaplyRig(HaplyService& s, const HaplyOptions& options)
      : service(s),
        devices{.force = std::make_unique<HaplyForceDevice>(options), .display = nullptr},
        device(static_cast<HaplyForceDevice&>(*devices.force)),
        gate(gate_limits(devices, 1000.0)) {}

  LinkReport report() const {
    LinkReport r;
    device.report(r);
    return r;
  }
  /// One tick, and no waiting for what comes of it.
  void tick(DeviceRequest request = DeviceRequest::none, double dt_s = 1e-3) {
    ++g_haply_ms;
    sample = device.exchange({.force_n = gate.before_sending(dt_s), .request = request}, dt_s);
    out = gate.pass({.force_n = wanted_n,
                     .force_device = sample.state,
                     .position_m = sample.position_m,
                     .position_age_s = sample.age_s,
                     .stiffness_n_per_m = stiffness_n_per_m,
                     .elastic_n = glm::length(wanted_n)},
                    dt_s);
  }
  /// One tick, and its answer heard by the link.
  bool answered_tick(DeviceRequest request = DeviceRequest::none) {
    const std::uint64_t heard = report().packets_in;
    tick(request);
    return emulation::eventually([&] { return report().packets_in > heard; }, 60.0);
  }
  /// Ticks until the device is in this state.
  bool reach(DeviceState state, DeviceRequest request = DeviceRequest::none) {
    for (int i = 0; i < 10 && sample.state != state; ++i) {
      if (!answered_tick(i == 0 ? request : DeviceRequest::none)) return false;
    }
    return sample.state == state;
  }
  /// Opened, homed, armed, and a newton at the service.
  Status push() {
    if (const Status opened = device.open(); !opened) return opened;
    return arm_and_push();
  }
  Status arm_and_push() {
    if (!reach(DeviceState::firmware)) return fail("no firmware");
    if (!reach(DeviceState::ready, DeviceRequest::home)) return fail("not ready");
    gate.arm();
    for (int i = 0; i < 300; ++i) {
      if (!answered_tick()) return fail("no answer");
    }
    return service.force_n().z > 0.99 ? Status{} : fail("no force");
  }
};

}  // namespace tangent::testing
