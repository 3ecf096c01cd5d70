// Stability limit of a stiff surface with the simulated hand, against theory, and the safety gate's reaction beyond it.
//
// One axis, in contact: m x'' = -k x - b x' + F, with F = -K x sampled at the start of the tick and held (zero-order
// hold). The hold delays by half a tick, so that roughly K T / 2 > b is unstable; the recurrence below gives the exact
// limit.
#include "tests/workbench/session/session_fixture.h"

#include "devices/simulated/simulated_force_device.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kDt = 1e-3;

/// Whether the oscillation grows; otherwise it decays.
bool theory_shakes(const SimulatedForceOptions& o, double stiffness) {
  const double m = o.device_mass_kg + o.hand_mass_kg;
  double x = 1e-3, v = 0.0, early = 0.0, late = 0.0;
  for (int tick = 0; tick < 8000; ++tick) {
    const double force = -stiffness * x;
    for (int i = 0; i < o.substeps; ++i) {  // as the device integrates
      const double h = kDt / o.substeps;
      v += h / m * (-o.hand_stiffness_n_per_m * x - o.hand_damping_n_s_per_m * v + force);
      x += h * v;
    }
    if (tick >= 3000 && tick < 4000) early = std::max(early, std::abs(x));
    if (tick >= 7000) late = std::max(late, std::abs(x));
    if (std::abs(x) > 1e6) return true;
  }
  return late > early;
}

double theory_limit(const SimulatedForceOptions& o) {
  double low = 100.0, high = 100e3;
  while (high / low > 1.001) {
    const double middle = std::sqrt(low * high);
    (theory_shakes(o, middle) ? high : low) = middle;
  }
  return low;
}

struct Run {
  double amplitude_m = 0.0;  ///< half of peak to peak over the last half second
  GateFault fault = GateFault::none;
  double energy_j = 0.0;  ///< most that the loop made
};

struct Wall {
  double stiffness_n_per_m = 0.0, damping_n_s_per_m = 0.0;
};

/// The hand presses on a sphere, straight down, with the solver in the loop.
Run press(SimulatedForceOptions o, Wall wall, double aim_m = 1e-3, int ticks = 3000) {
  o.tremor_m = 10e-6;
  DeviceSet set;
  set.force = std::make_unique<SimulatedForceDevice>(o);
  REQUIRE(set.force->open());
  Preset preset;
  preset.force.stiffness_n_per_m = wall.stiffness_n_per_m;
  preset.force.damping_n_s_per_m = wall.damping_n_s_per_m;
  TickBench bench(std::move(set), sphere_scene(), preset);
  const double top = 0.040 + preset.finger.radius_m;
  HandCommand hand;
  hand.settings.mode = HandMode::point;
  hand.point_m = Vec3(0, 0, top + 2e-3);  // armed off the surface
  bench.channels.hand.put(hand);
  bench.arm();
  REQUIRE(bench.run(500).device.gate_state == GateState::armed);
  for (int i = 1; i <= 500; ++i) {  // slowly: a tap on so hard a surface bounces
    hand.point_m = Vec3(0, 0, top + 2e-3 - (2e-3 + aim_m) * i / 500);
    bench.channels.hand.put(hand);
    bench.run();
  }
  Run run;
  double low = 1e9, high = -1e9;
  for (int i = 0; i < ticks; ++i) {
    const ServoRecord r = bench.run();
    if (i >= ticks - 500) {
      low = std::min(low, r.tick.input.finger.position.z);
      high = std::max(high, r.tick.input.finger.position.z);
    }
    if (run.fault == GateFault::none) run.fault = r.device.gate_fault;
    run.energy_j = std::max(run.energy_j, r.device.energy_j);
  }
  run.amplitude_m = 0.5 * (high - low);
  return run;
}

}  // namespace

TEST_CASE("contact is stable below the stiffness theory gives for the hand and shakes above it") {
  for (const double damping : {2.0, 4.0, 8.0}) {
    SimulatedForceOptions o;
    o.hand_damping_n_s_per_m = damping;
    o.friction_n = o.position_step_m = 0.0;
    const double limit = theory_limit(o);
    // Long enough for the landing to have died away.
    const Run below = press(o, {0.8 * limit}, 1e-3, 6000), above = press(o, {1.3 * limit}, 1e-3, 6000);
    MESSAGE("hand damping " << damping << " N s/m: shakes from " << limit << " N/m; at 0.8 of it by "
                            << below.amplitude_m * 1e6 << " um, at 1.3 of it by " << above.amplitude_m * 1e6 << " um");
    CHECK(below.amplitude_m < 25e-6);  // tremor of 10 um RMS
    CHECK(above.amplitude_m > 5.0 * below.amplitude_m);
    CHECK(below.fault == GateFault::none);
  }
}

TEST_CASE("a hand that presses hard on a shaking contact is spared: the gate stops it, and leaves a stable one alone") {
  for (const double damping : {4.0, 8.0}) {
    SimulatedForceOptions o;
    o.hand_damping_n_s_per_m = damping;
    o.friction_n = o.position_step_m = 0.0;
    const double limit = theory_limit(o);
    CHECK(press(o, {0.8 * limit}, 10e-3).fault == GateFault::none);
    for (const double beyond : {1.3, 2.0}) {
      const Run run = press(o, {beyond * limit}, 10e-3);
      MESSAGE("hand damping " << damping << " N s/m, " << beyond << " of the limit: " << run.amplitude_m * 1e6
                              << " um in the end, at most " << run.energy_j * 1e3 << " mJ made");
      CHECK(run.fault == GateFault::shaking);
      CHECK(run.amplitude_m < 0.5e-3);
    }
  }
}

TEST_CASE("the simulated device renders the damping that it names without trembling, and not three times that") {
  SimulatedForceOptions o;
  o.hand_damping_n_s_per_m = 4.0;  // a hand that damps little itself
  o.friction_n = 0.0;
  const double largest = SimulatedForceDevice(o).capabilities().largest_damping_n_s_per_m;
  REQUIRE(largest > 0.0);
  const double step = o.position_step_m;
  for (const double share : {0.1, 0.5, 1.0}) {
    const Run soft = press(o, {100.0, share * largest}, 10e-3), hard = press(o, {2000.0, share * largest}, 10e-3);
    MESSAGE((share * largest) << " N s/m: " << soft.amplitude_m * 1e6 << " um on 100 N/m, " << hard.amplitude_m * 1e6
                              << " um on 2,000 N/m");
    CHECK(std::max(soft.amplitude_m, hard.amplitude_m) <= 1.01 * step);
  }
  const Run beyond = press(o, {2000.0, 3.4 * largest}, 10e-3);
  MESSAGE((3.4 * largest) << " N s/m: " << beyond.amplitude_m * 1e6 << " um");
  CHECK(beyond.amplitude_m > 3.0 * step);
}
