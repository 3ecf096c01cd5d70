// Faults injected by name into the simulated devices, through the whole servo: time until the force is zero.
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Outcome {
  int ticks_to_fault = 0;  ///< from the injection to the gate's fault
  int ticks_to_zero = 0;   ///< from the gate's fault to no force at the device
  GateFault fault = GateFault::none;
};

Outcome inject(InjectedFault kind, bool display) {
  TickBench bench(simulated(), sphere_scene());
  if (bench.devices.force) REQUIRE(bench.devices.force->open());
  if (bench.devices.display) REQUIRE(bench.devices.display->open());
  bench.arm();
  REQUIRE(glm::length(bench.run(1500).device.force_rendered_n) > 0.3);
  bench.channels.faults.put({{kind, 200}, display});
  Outcome outcome;
  ServoRecord r;
  do {
    r = bench.run();
    ++outcome.ticks_to_fault;
    if (outcome.ticks_to_fault > 400) return outcome;
  } while (r.device.gate_fault == GateFault::none);
  outcome.fault = r.device.gate_fault;
  // The command of this tick reaches the device in the next.
  while (r.device.force_rendered_n != Vec3(0.0) || r.device.force_command_n != Vec3(0.0)) {
    r = bench.run();
    REQUIRE(++outcome.ticks_to_zero < 100);
  }
  MESSAGE(std::string(to_string(kind)) << std::string(display ? ", display: " : ", force device: ")
                                       << outcome.ticks_to_fault << " ticks until "
                                       << std::string(to_string(outcome.fault)) << ", " << outcome.ticks_to_zero
                                       << " more without force");
  for (int i = 0; i < 300; ++i) {  // the fault passes; the force stays away
    r = bench.run();
    CHECK(r.device.force_command_n == Vec3(0.0));
    CHECK(r.device.gate_state == GateState::faulted);
  }
  bench.arm();
  CHECK(bench.run(1500).device.gate_state == GateState::armed);
  return outcome;
}

}  // namespace

TEST_CASE("every fault injected into the force device is found, and the force is gone within two ticks of it") {
  const Outcome drop_out = inject(InjectedFault::drop_out, false);
  CHECK(drop_out.fault == GateFault::force_device);
  CHECK(drop_out.ticks_to_fault == 1);
  CHECK(drop_out.ticks_to_zero <= 2);
  const Outcome noise = inject(InjectedFault::noise, false);
  CHECK(noise.fault == GateFault::position_jumped);
  CHECK(noise.ticks_to_fault <= 2);
  CHECK(noise.ticks_to_zero <= 2);
  const Outcome delay = inject(InjectedFault::delay_burst, false);
  CHECK(delay.fault == GateFault::stale_sample);
  CHECK(delay.ticks_to_fault <= 11);  // 10 ms old is the oldest that may make a force
  CHECK(delay.ticks_to_zero <= 2);
  const Outcome stuck = inject(InjectedFault::stuck_encoder, false);
  CHECK(stuck.fault == GateFault::position_frozen);
  CHECK(stuck.ticks_to_fault <= 24);  // 20 equal readings, and those that were equal by chance before
  CHECK(stuck.ticks_to_zero <= 2);
}

TEST_CASE("every fault injected into the display is found, and the force is gone within two ticks of it") {
  const Outcome drop_out = inject(InjectedFault::drop_out, true);
  CHECK(drop_out.fault == GateFault::contact_display);
  CHECK(drop_out.ticks_to_fault == 1);
  CHECK(drop_out.ticks_to_zero <= 2);
  const Outcome delay = inject(InjectedFault::delay_burst, true);
  CHECK(delay.fault == GateFault::stale_sample);
  CHECK(delay.ticks_to_zero <= 2);
  const Outcome noise = inject(InjectedFault::noise, true);
  CHECK(noise.fault == GateFault::display_jumped);
  CHECK(noise.ticks_to_zero <= 2);
  const Outcome stuck = inject(InjectedFault::stuck_encoder, true);
  CHECK(stuck.fault == GateFault::display_frozen);
  CHECK(stuck.ticks_to_zero <= 2);
}
