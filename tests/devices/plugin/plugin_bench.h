// The force device "plugin" behind a safety gate, stepped tick by tick, for the tests. No time-out of the driver's own
// is near: what is to happen is waited for, however long it takes.
#pragma once

#include "devices/device_safety.h"
#include "devices/plugin/plugin_device.h"
#include "devices/safety_gate.h"
#include "tests/support/paths.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <utility>

namespace tangent::testing {

inline constexpr double kForever_s = 3600.0;

inline PluginOptions patient_plugin(const std::string& fault = {}, std::uint64_t at = 0) {
  PluginOptions options;
  options.path = testing::faulty_plugin();
  options.host = testing::plugin_host();
  if (!fault.empty())
    options.settings = {{"fault", fault}, {"at", std::to_string(at)}, {"for", std::to_string(1'000'000)}};
  options.wait_s = options.watchdog_s = options.hang_s = options.kill_s = options.open_s = options.end_s = kForever_s;
  options.restart_s = 0.01;
  options.realtime = false;
  return options;
}

/// Until `happened`, for minutes if need be.
inline bool in_the_end(const std::function<bool()>& happened) {
  constexpr int kMost = 120'000;
  for (int i = 0; i < kMost; ++i) {
    if (happened()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

struct PluginBench {
  static constexpr double kDt_s = 1e-3;

  explicit PluginBench(PluginOptions options) : device(std::move(options)), gate(limits()) {
    const Status ok = device.open();
    REQUIRE_MESSAGE(ok, (ok ? "" : ok.error().message()));
  }

  GateLimits limits() const {
    GateLimits l;
    l.peak_force_n = device.capabilities().peak_force_n;
    l.workspace_half_size_m = device.capabilities().workspace_half_size_m;
    l.ramp_s = 0.01;
    return l;
  }

  /// One tick of the servo that asks for 1 N.
  void step(DeviceRequest request = DeviceRequest::none) {
    const Vec3 force = gate.before_sending(kDt_s);
    sample = device.exchange({.tick = tick++, .force_n = force, .request = request}, kDt_s);
    CHECK(std::isfinite(sample.position_m.x + sample.position_m.y + sample.position_m.z + sample.age_s));
    out = gate.pass({.force_n = Vec3(0.0, 0.0, 1.0),
                     .force_device = sample.state,
                     .position_m = sample.position_m,
                     .position_age_s = sample.age_s},
                    kDt_s);
  }
  void step(int ticks) {
    for (int i = 0; i < ticks; ++i) step();
  }
  bool pushes() const { return device.sent_n() != Vec3(0.0); }
  bool faulted() const { return sample.state != DeviceState::ready || out.state == GateState::faulted; }
  /// Ready and armed, with its full force.
  void arm() {
    REQUIRE(in_the_end([&] {
      step();
      return sample.state == DeviceState::ready;
    }));
    gate.arm();
    step(30);
    REQUIRE(gate.state() == GateState::armed);
    REQUIRE(pushes());
  }
  std::string problem() const {
    LinkReport report;
    device.report(report);
    return report.problem;
  }

  PluginForceDevice device;
  SafetyGate gate;
  ForceSample sample;
  GateOutput out;
  std::uint64_t tick = 0;
};

}  // namespace tangent::testing
