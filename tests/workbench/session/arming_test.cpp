#include "workbench/session/arming.h"

#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kArmingTick_s = 1e-3;

/// A device that does as it is asked, after a while; told to, it never gets through homing.
struct MadeUpDevice {
  DeviceState state = DeviceState::firmware;
  int homing_takes = 20;
  int homing_for = 0, homed = 0, cleared = 0, stopped = 0;
  bool fails = false;  ///< homing ends in a fault

  void take(DeviceRequest request) {
    if (state == DeviceState::open) state = DeviceState::firmware;
    const bool may_home = state == DeviceState::firmware || state == DeviceState::ready;
    if (request == DeviceRequest::home && may_home) {
      state = DeviceState::homing;
      homing_for = 0;
      ++homed;
    } else if (request == DeviceRequest::clear_fault && state == DeviceState::faulted) {
      state = DeviceState::open;
      ++cleared;
    } else if (request == DeviceRequest::stop && state == DeviceState::homing) {
      state = DeviceState::open;
      ++stopped;
    } else if (state == DeviceState::homing && ++homing_for >= homing_takes) {
      state = fails ? DeviceState::faulted : DeviceState::ready;
    }
  }
};

struct ArmingBench {
  MadeUpDevice force, display;
  Arming arming;
  ArmingView seen;
  int armed = 0;

  explicit ArmingBench(double homing_s = 10.0) : arming(homing_s, homing_s) { seen.known = true; }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kArmingTick_s + 0.5); ++i) {
      seen.force = force.state;
      seen.display = display.state;
      const ArmingOrders orders = arming.update(seen, kArmingTick_s);
      force.take(orders.force);
      display.take(orders.display);
      if (!orders.arm) continue;
      ++armed;
      seen.live = true;
      seen.gate_faulted = false;
    }
  }
};

}  // namespace

TEST_CASE("arming homes what is not homed, arms once, and is done") {
  ArmingBench b;
  b.arming.ask(ForceSwitch::arm);
  CHECK(b.arming.stage() == ArmingStage::arming);
  b.run(0.1);
  CHECK(b.armed == 1);
  CHECK(b.force.homed == 1);
  CHECK(b.display.homed == 1);
  CHECK(b.arming.stage() == ArmingStage::idle);
  b.seen.live = false;
  b.run(10.0);
  CHECK(b.armed == 1);
}

TEST_CASE("a wish to arm is given up after 5 s, and nothing arms later - a new one is a new attempt") {
  ArmingBench b(100.0);
  b.display.homing_takes = 8000;
  b.arming.ask(ForceSwitch::arm);
  b.run(4.9);
  CHECK(b.arming.stage() == ArmingStage::arming);
  CHECK(b.arming.obstacle() == ArmingObstacle::not_homed);
  b.run(0.2);
  CHECK(b.arming.stage() == ArmingStage::given_up);
  b.run(60.0);
  CHECK(b.display.state == DeviceState::ready);
  CHECK(b.armed == 0);
  b.arming.ask(ForceSwitch::arm);
  b.run(0.1);
  CHECK(b.armed == 1);
}

TEST_CASE("a device that faults while it homes is cleared and homed once for each press") {
  ArmingBench b;
  b.display.fails = true;
  b.arming.ask(ForceSwitch::arm);
  b.run(64.0);
  CHECK(b.display.homed == 1);
  CHECK(b.display.cleared == 0);
  CHECK(b.arming.stage() == ArmingStage::given_up);
  CHECK(b.arming.obstacle() == ArmingObstacle::fault);
  for (int press = 1; press <= 3; ++press) {
    b.arming.ask(ForceSwitch::arm);
    b.run(20.0);
    CHECK(b.display.cleared == press);
    CHECK(b.display.homed == 1 + press);
    CHECK(b.armed == 0);
  }
  b.display.fails = false;  // it would work now, but nobody asks
  b.run(64.0);
  CHECK(b.armed == 0);
}

TEST_CASE("a stop ends homing and clearing, and cancels what is pending, in every state") {
  for (const ForceSwitch wish : {ForceSwitch::arm, ForceSwitch::home}) {
    ArmingBench b;
    b.display.homing_takes = 100'000;
    b.arming.ask(wish);
    b.run(0.5);
    REQUIRE(b.display.state == DeviceState::homing);
    b.arming.ask(ForceSwitch::stop);
    b.run(10.0);
    CHECK(b.display.stopped == 1);
    CHECK(b.display.homed == 1);
    CHECK(b.display.state == DeviceState::firmware);
    CHECK(b.armed == 0);
    CHECK(b.arming.stage() == ArmingStage::idle);
  }
}

TEST_CASE("a stop reaches a device whose homing was still on its way through the cable") {
  ArmingBench b;
  b.arming.ask(ForceSwitch::arm);
  b.run(0.001);
  b.arming.ask(ForceSwitch::stop);
  b.run(0.005);
  b.display.state = DeviceState::homing;
  b.run(0.5);
  CHECK(b.display.stopped >= 1);
  CHECK(b.display.state == DeviceState::firmware);
}

TEST_CASE("homing is given up after the device's own limit, and stopped there - by hand it takes as long as it takes") {
  ArmingBench limited(2.0);
  limited.force.homing_takes = limited.display.homing_takes = 100'000;
  limited.arming.ask(ForceSwitch::home);
  limited.run(1.9);
  CHECK(limited.force.state == DeviceState::homing);
  limited.run(0.2);
  CHECK(limited.force.state == DeviceState::firmware);
  limited.run(30.0);
  CHECK(limited.force.homed == 1);
  CHECK(limited.force.stopped == 1);
  CHECK(limited.arming.stage() == ArmingStage::idle);

  ArmingBench by_hand(0.0);
  by_hand.arming.ask(ForceSwitch::arm);
  by_hand.run(2.0);
  CHECK(by_hand.force.homed + by_hand.display.homed == 0);
  CHECK(by_hand.arming.obstacle() == ArmingObstacle::not_homed);
  by_hand.force.state = by_hand.display.state = DeviceState::homing;  // a person moves it there
  by_hand.run(1.0);
  CHECK(by_hand.force.stopped == 0);
  by_hand.force.state = by_hand.display.state = DeviceState::ready;
  by_hand.run(0.01);
  CHECK(by_hand.armed == 1);
}

TEST_CASE("what is in the way is told in this order: fault, homing, workspace, depth") {
  ArmingBench b;
  b.seen.force_wanted_n = 3.0;
  b.seen.outside = true;
  b.display.state = DeviceState::faulted;
  b.force.state = DeviceState::ready;
  b.arming.ask(ForceSwitch::stop);
  b.run(0.01);
  CHECK(b.arming.obstacle() == ArmingObstacle::fault);
  b.display.state = DeviceState::firmware;
  b.run(0.01);
  CHECK(b.arming.obstacle() == ArmingObstacle::not_homed);
  b.display.state = DeviceState::ready;
  b.run(0.01);
  CHECK(b.arming.obstacle() == ArmingObstacle::outside);
  b.seen.outside = false;
  b.seen.unready = true;
  b.run(0.01);
  CHECK(b.arming.obstacle() == ArmingObstacle::unready);
  b.seen.unready = false;
  b.run(0.01);
  CHECK(b.arming.obstacle() == ArmingObstacle::finger_at_depth);
  CHECK(arming_text(ArmingStage::given_up, b.arming.obstacle(), 3.0) ==
        "Not armed: the finger is in the surface (3.00 N). Move the finger off the surface");
  b.seen.force_wanted_n = 0.19;
  b.run(0.01);
  CHECK(b.arming.obstacle() == ArmingObstacle::none);
  CHECK(arming_text(ArmingStage::idle, ArmingObstacle::none, 0.0).empty());
  b.seen.gate_faulted = true;
  b.run(0.01);
  CHECK(b.arming.obstacle() == ArmingObstacle::fault);
  CHECK(b.armed == 0);
  b.arming.ask(ForceSwitch::arm);
  b.run(0.01);
  CHECK(b.armed == 1);
}

TEST_CASE("a force that is no number is no reason to arm") {
  ArmingBench b;
  b.force.state = b.display.state = DeviceState::ready;
  b.seen.force_wanted_n = std::numeric_limits<double>::quiet_NaN();
  b.arming.ask(ForceSwitch::arm);
  b.run(6.0);
  CHECK(b.armed == 0);
}

TEST_CASE("while force is let through a second wish to arm changes nothing") {
  ArmingBench b;
  b.arming.ask(ForceSwitch::arm);
  b.run(0.1);
  REQUIRE(b.armed == 1);
  b.arming.ask(ForceSwitch::arm);
  b.run(1.0);
  CHECK(b.armed == 1);
  CHECK(b.arming.stage() == ArmingStage::idle);
}

// --- In the servo --------------------------------------------------------------------------------------

namespace {

struct HeldFinger {
  PuppetForceDevice* device = new PuppetForceDevice;
  TickBench bench;
  HeldFinger() : bench(with(device), sphere_scene()) {}
  static DeviceSet with(PuppetForceDevice* puppet) {
    DeviceSet set;
    set.force.reset(puppet);
    return set;
  }
  double most_sent() const {
    double most = 0.0;
    for (const ForceCommand& c : device->commands) most = std::max(most, glm::length(c.force_n));
    return most;
  }
};

}  // namespace

TEST_CASE(
    "with the finger 5 to 30 mm deep arming waits and says so, nothing pushes, and it arms as the finger is out") {
  for (const double depth_m : {5e-3, 10e-3, 30e-3}) {
    CAPTURE(depth_m);
    HeldFinger f;
    f.device->position = Vec3(0.0, 0.0, 0.060 - depth_m);
    f.bench.arm();
    for (int i = 0; i < 3000; ++i) {
      const ServoRecord r = f.bench.run();
      REQUIRE(r.device.force_command_n == Vec3(0.0));
      if (i < 5) continue;
      CHECK(r.device.arming == ArmingStage::arming);
      CHECK(r.device.in_the_way == ArmingObstacle::finger_at_depth);
    }
    f.device->position = Vec3(0.0, 0.0, 0.0599);
    const ServoRecord r = f.bench.run(400);
    CHECK(r.device.gate_state == GateState::armed);
    CHECK(f.most_sent() < kMostArmingForce_n);
  }
}

TEST_CASE("a stop that comes with a wish to arm is the one that counts, whatever their order") {
  HeldFinger f;
  f.device->position = Vec3(0.0, 0.0, 0.0605);
  f.bench.channels.stop = true;
  f.bench.arm();
  CHECK(f.bench.run(1000).device.gate_state == GateState::disarmed);
  f.bench.arm();
  CHECK(f.bench.run(1000).device.gate_state == GateState::armed);
  f.bench.channels.stop = true;
  f.bench.arm();
  CHECK(f.bench.run(1000).device.gate_state == GateState::disarmed);
}

TEST_CASE("a stop does not clear a fault, and neither presets nor scenes arm") {
  HeldFinger f;
  f.device->position = Vec3(0.0, 0.0, 0.0605);
  f.bench.arm();
  REQUIRE(f.bench.run(400).device.gate_state == GateState::armed);
  f.device->state = DeviceState::faulted;
  REQUIRE(f.bench.run().device.gate_fault == GateFault::force_device);
  f.device->state = DeviceState::ready;
  f.bench.channels.stop = true;
  ServoRecord r = f.bench.run(50);
  CHECK(r.device.gate_state == GateState::faulted);
  CHECK(r.device.gate_fault == GateFault::force_device);
  Preset preset;
  preset.force.stiffness_n_per_m = 1000.0;
  f.bench.channels.presets.put({1, preset});
  f.bench.channels.scenes.offer(std::make_unique<PreparedScene>(torus_scene(), Finger{}));
  r = f.bench.run(6000);
  CHECK(r.device.gate_state == GateState::faulted);
  CHECK(f.most_sent() == 0.0);
}

TEST_CASE("a simulated hand that explores lifts the finger to be armed, and goes on") {
  TickBench bench(simulated(), sphere_scene());
  REQUIRE(bench.devices.force->open());
  REQUIRE(bench.devices.display->open());
  bench.arm();
  REQUIRE(bench.run(1500).tick.output.penetration_m > 0.5e-3);
  bench.channels.stop = true;
  const ServoRecord stopped = bench.run(1000);
  REQUIRE(stopped.device.gate_state == GateState::disarmed);
  CHECK(stopped.tick.output.penetration_m > 1.5e-3);  // without force the hand presses as deep as it aims
  bench.arm();
  ServoRecord r = bench.run();
  for (int i = 0; i < 1500 && r.device.gate_state == GateState::disarmed; ++i) r = bench.run();
  CHECK(r.tick.output.penetration_m < 0.25e-3);  // 0.2 N at 800 N/m
  r = bench.run(1500);
  CHECK(r.device.gate_state == GateState::armed);
  CHECK(r.tick.output.penetration_m > 0.5e-3);
}

TEST_CASE("a display that is plugged in long after arming homes by itself, however long that took") {
  for (const double away_s : {1.0, 9.0, 11.0, 60.0}) {
    CAPTURE(away_s);
    HomingWish wish(10.0);
    for (double t = 0.0; t < away_s; t += 1e-3)
      CHECK(wish.next(DeviceState::absent, true, 1e-3) == DeviceRequest::none);
    wish.next(DeviceState::open, true, 1e-3);
    CHECK(wish.next(DeviceState::firmware, true, 1e-3) == DeviceRequest::home);
  }
}
