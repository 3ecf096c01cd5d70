// Fault x ticks to notice x ticks to zero force, counted in ticks that the test steps.
#include "tests/devices/usb/falcon_rig.h"

#include <cstdio>

using namespace tangent;
using namespace tangent::emulation;

namespace {

struct FalconFaultCase {
  const char* name;
  void (*cause)(FalconRig& rig);
  int notice_within;  ///< ticks
};

/// Ticks from the cause to the first in which driver or gate acts on it, and from there to the first without force.
struct FaultTicks {
  int to_notice = 0, to_zero = 0;
  DeviceFault fault = DeviceFault::none;
  GateFault gate = GateFault::none;
};

const FalconFaultCase kFalconFaults[]{
    {"unplugged", [](FalconRig& r) { r.unplug(); }, 1},
    {"no answers", [](FalconRig& r) { r.model.fault = FalconFault::silent; }, 6},
    {"transfers stall, both ways",
     [](FalconRig& r) {
       r.model.fault = FalconFault::silent;
       r.takes_transfers = false;
     },
     12},
    {"garbage instead of packets", [](FalconRig& r) { r.model.fault = FalconFault::garbage; }, 2},
    {"packets cut short", [](FalconRig& r) { r.model.fault = FalconFault::cut; }, 6},
    {"a place outside the workspace", [](FalconRig& r) { r.model.fault = FalconFault::far_away; }, 2},
    {"encoders that no place has", [](FalconRig& r) { r.model.fault = FalconFault::legs_apart; }, 2},
    {"a leg that lost its zero", [](FalconRig& r) { r.model.fault = FalconFault::unhomed; }, 2},
    {"time runs backwards by 50 ms", [](FalconRig& r) { r.now_ns -= 50'000'000; }, 1},
    {"a force that is not a number", [](FalconRig& r) { r.wanted_n = Vec3(std::nan("")); }, 1},
    {"the motors lose their power", [](FalconRig& r) { r.model.running = false; }, 12},
};

FaultTicks measured(const FalconFaultCase& c) {
  FalconOptions options;
  options.torque_counts_per_nm = 10'000.0;
  FalconRig rig(options);
  rig.plug_in();
  rig.make_ready();
  rig.push({0.0, 0.0, 1.0});
  REQUIRE(rig.pushes());
  REQUIRE(rig.gate.state() == GateState::armed);
  c.cause(rig);
  // Force is asked for, in the exchange's command or by what the device was told, until it is taken back.
  const auto is_pushed = [&rig] { return rig.pushes(); };
  FaultTicks out;
  do {
    rig.tick();
    ++out.to_notice;
  } while (!rig.noticed() && is_pushed() && out.to_notice < 1000);
  for (; is_pushed() && out.to_zero < 1000; ++out.to_zero) rig.tick();
  for (int i = 0; i < 40; ++i) {
    rig.tick();
    CHECK_FALSE(is_pushed());
  }
  out.fault = rig.sample.fault;
  out.gate = rig.gate.fault();
  return out;
}

}  // namespace

TEST_CASE("Falcon: every fault is noticed in time, the force is gone within two ticks of it, and it stays away") {
  for (const FalconFaultCase& c : kFalconFaults) {
    CAPTURE(std::string(c.name));
    const FaultTicks ticks = measured(c);
    CHECK(ticks.to_notice <= c.notice_within);
    CHECK(ticks.to_zero <= 2);
  }
}

TEST_CASE("measure: faults of falcon" * doctest::skip()) {
  std::printf("| fault | ticks to notice | ticks to zero force | device says | gate says |\n|---|---|---|---|---|\n");
  for (const FalconFaultCase& c : kFalconFaults) {
    const FaultTicks t = measured(c);
    std::printf("| %s | %d | %d | %s | %s |\n", c.name, t.to_notice, t.to_zero, to_string(t.fault), to_string(t.gate));
  }
}
