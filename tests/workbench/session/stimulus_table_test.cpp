// What a hand gets from the whole servo when something goes wrong: the table in devices/README.md.
#include "tests/workbench/session/session_fixture.h"

#include "devices/simulated/simulated_force_device.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Answer {
  double largest_n = 0.0;       ///< at the device, from the stimulus on
  double largest_step_n = 0.0;  ///< change from exchange to exchange, the drops to zero apart
  int ticks_to_zero = -1;       ///< from the stimulus to the first exchange without force; -1: the force goes on
  double fastest_m_per_s = 0.0;
  GateFault fault = GateFault::none;
};

/// The simulated hand rests 3 mm deep, against 1,000 N/m, when `stimulus` comes: it may change the bench, and says how
/// long the next tick is. Then four seconds more.
struct Stimulated {
  SimulatedForceDevice* device = new SimulatedForceDevice;
  TickBench bench;

  static DeviceSet with(SimulatedForceDevice* force) {
    auto set = make_devices(DeviceNames{});
    REQUIRE(set);
    set->force.reset(force);
    return std::move(*set);
  }
  static Preset firm() {
    Preset preset;
    preset.force.stiffness_n_per_m = 1000.0;
    return preset;
  }
  Stimulated() : bench(with(device), sphere_scene(), firm()) {
    REQUIRE(open_devices(bench.devices));
    HandCommand hand;
    hand.settings.mode = HandMode::point;
    hand.point_m = Vec3(0, 0, 0.040 + Finger{}.radius_m + 2e-3);
    bench.channels.hand.put(hand);
    bench.arm();
    REQUIRE(bench.run(600).device.gate_state == GateState::armed);
    hand.point_m.z -= 12e-3;
    bench.channels.hand.put(hand);
    REQUIRE(glm::length(bench.run(2000).device.force_rendered_n) > 2.0);
  }

  Answer answer(const std::function<double(Stimulated&)>& stimulus) {
    Answer a;
    double dt = stimulus(*this);
    Vec3 last(0.0);
    for (int i = 0; i < 4000; ++i) {
      TickTiming timing = bench.pacer.begin(bench.pacer.deadline_ns());
      timing.dt_s = dt;
      dt = 1e-3;
      bench.tick->run(timing);
      ServoRecord r;
      REQUIRE(bench.channels.gui.pop(r));
      const Vec3 force = r.device.force_rendered_n;
      a.largest_n = std::max(a.largest_n, glm::length(force));
      if (i > 0 && force != Vec3(0.0) && glm::length(force) > 0.51 * glm::length(last))
        a.largest_step_n = std::max(a.largest_step_n, glm::length(force - last));
      if (a.ticks_to_zero < 0 && force == Vec3(0.0)) a.ticks_to_zero = i;
      a.fastest_m_per_s = std::max(a.fastest_m_per_s, glm::length(device->velocity_m_per_s()));
      if (a.fault == GateFault::none) a.fault = r.device.gate_fault;
      last = force;
    }
    return a;
  }
};

Answer answer_to(const char* name, const std::function<double(Stimulated&)>& stimulus) {
  Stimulated s;
  const Answer a = s.answer(stimulus);
  char text[200];
  std::snprintf(text, sizeof text, "%s | largest %.2f N, step %.2f N | zero after %d ticks | hand %.3f m/s | %s", name,
                a.largest_n, a.largest_step_n, a.ticks_to_zero, a.fastest_m_per_s, to_string(a.fault));
  MESSAGE(std::string(text));
  CHECK(a.largest_n <= 8.5);
  CHECK(a.largest_step_n <= 2.0 * (1.0 + 1e-9));
  return a;
}

}  // namespace

TEST_CASE("what a hand gets: force out, time to zero and its speed, for each thing that goes wrong") {
  const Answer stop = answer_to("stop", [](Stimulated& s) {
    s.bench.channels.force.put(ForceSwitch::stop);
    return 1e-3;
  });
  CHECK(stop.ticks_to_zero == 0);
  const Answer stall = answer_to("stall of 30 ms", [](Stimulated&) { return 30e-3; });
  CHECK(stall.ticks_to_zero == 0);
  CHECK(stall.fault == GateFault::late_tick);
  const Answer short_stall = answer_to("stall of 12 ms", [](Stimulated&) { return 12e-3; });
  CHECK(short_stall.ticks_to_zero == 0);
  CHECK(short_stall.fault == GateFault::none);
  const Answer gone = answer_to("drop-out", [](Stimulated& s) {
    s.device->inject(FaultInjection{InjectedFault::drop_out, 200});
    return 1e-3;
  });
  CHECK(gone.ticks_to_zero <= 2);
  const Answer noise = answer_to("noise of 20 mm", [](Stimulated& s) {
    s.device->inject(FaultInjection{InjectedFault::noise, 200});
    return 1e-3;
  });
  CHECK(noise.ticks_to_zero <= 3);
  const Answer late = answer_to("no new sample", [](Stimulated& s) {
    s.device->inject(FaultInjection{InjectedFault::delay_burst, 200});
    return 1e-3;
  });
  CHECK(late.ticks_to_zero <= 12);
  CHECK(late.fault == GateFault::stale_sample);
  const Answer stiffer = answer_to("1,000 to 3,500 N/m", [](Stimulated& s) {
    Preset preset = Stimulated::firm();
    preset.force.stiffness_n_per_m = 3500.0;
    s.bench.channels.presets.put({1, preset});
    return 1e-3;
  });
  CHECK(stiffer.ticks_to_zero < 0);
  CHECK(stiffer.fault == GateFault::none);
  const Answer shaking = answer_to("1,000 to 40,000 N/m, which shakes", [](Stimulated& s) {
    Preset preset = Stimulated::firm();
    preset.force.stiffness_n_per_m = 40'000.0;
    s.bench.channels.presets.put({1, preset});
    return 1e-3;
  });
  CHECK(shaking.fault == GateFault::shaking);
}
