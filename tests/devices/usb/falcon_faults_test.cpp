// Fault x ticks to notice x ticks to zero force, counted in ticks that the test steps.
#include "tests/devices/usb/falcon_rig.h"

#include <cstdio>

using namespace tangent;
using namespace tangent::emulation;

namespace {

struct FalconFaultCase {
  const char* name;
  void (*cause)(FalconRig& rig);
  int notice_within;    ///< ticks
  bool moving = false;  ///< the hand moves, 0.2 m/s
};

/// Ticks from the cause to the first in which driver or gate acts on it, and to the first without force.
struct FaultTicks {
  int to_notice = 0, to_zero = 0, to_fault = 0;  ///< fault: it has to be armed anew
  DeviceFault fault = DeviceFault::none;
  GateFault gate = GateFault::none;
};

const FalconFaultCase kFalconFaults[]{
    {"unplugged", [](FalconRig& r) { r.unplug(); }, 1},
    {"no answers", [](FalconRig& r) { r.model.fault = FalconFault::silent; }, 4},
    {"transfers stall, both ways",
     [](FalconRig& r) {
       r.model.fault = FalconFault::silent;
       r.takes_transfers = false;
     },
     4},
    {"garbage instead of packets", [](FalconRig& r) { r.model.fault = FalconFault::garbage; }, 2},
    {"packets cut short", [](FalconRig& r) { r.model.fault = FalconFault::cut; }, 4},
    {"encoders that stand still, in motion", [](FalconRig& r) { r.model.fault = FalconFault::frozen; }, 20, true},
    {"a place outside the workspace", [](FalconRig& r) { r.model.fault = FalconFault::far_away; }, 2},
    {"encoders that no place has", [](FalconRig& r) { r.model.fault = FalconFault::legs_apart; }, 2},
    {"a leg that lost its zero", [](FalconRig& r) { r.model.fault = FalconFault::unhomed; }, 2},
    {"time runs backwards by 50 ms", [](FalconRig& r) { r.now_ns -= 50'000'000; }, 1},
    {"a force that is not a number", [](FalconRig& r) { r.wanted_n = Vec3(std::nan("")); }, 1},
    {"it loses its power", [](FalconRig& r) { r.model.running = false; }, 4},
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
  double way_m = 0.0;
  const auto tick = [&] {
    if (c.moving) rig.model.hand_m = kFalconCentre_m + Vec3(0.0, way_m += 0.2e-3, 0.0);
    rig.tick();
  };
  for (int i = 0; c.moving && i < 60; ++i) tick();
  c.cause(rig);
  // Force is asked for, in the exchange's command or by what the device was told, until it is taken back.
  const auto is_pushed = [&rig] { return rig.pushes(); };
  FaultTicks out;
  do {
    tick();
    ++out.to_notice;
  } while (!rig.noticed() && is_pushed() && out.to_notice < 1000);
  out.to_fault = rig.noticed() ? out.to_notice : 0;
  for (out.to_zero = out.to_notice; is_pushed() && out.to_zero < 1000; ++out.to_zero) tick();
  for (int i = 1; i <= 40; ++i) {
    tick();
    if (out.to_fault == 0 && rig.noticed()) out.to_fault = out.to_zero + i;
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
    CHECK(ticks.to_zero - ticks.to_notice <= 2);
    CHECK(ticks.to_fault > 0);
  }
}

TEST_CASE("measure: faults of falcon" * doctest::skip()) {
  std::printf(
      "| fault | ticks to notice | ticks to zero force | ticks to the fault | device says | gate says |\n"
      "|---|---|---|---|---|---|\n");
  for (const FalconFaultCase& c : kFalconFaults) {
    const FaultTicks t = measured(c);
    std::printf("| %s | %d | %d | %d | %s | %s |\n", c.name, t.to_notice, t.to_zero, t.to_fault, to_string(t.fault),
                to_string(t.gate));
  }
}
