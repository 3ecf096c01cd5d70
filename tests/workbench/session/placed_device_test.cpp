#include "workbench/session/placed_device.h"

#include "tests/support/approx.h"
#include "tests/workbench/session/session_fixture.h"
#include "workbench/session/session.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

const Quat kQuarter = glm::angleAxis(std::numbers::pi / 2.0, Vec3(0.0, 0.0, 1.0));

struct PuppetBench {
  PuppetForceDevice* device = new PuppetForceDevice;
  TickBench bench;

  static DeviceSet with(PuppetForceDevice* puppet) {
    DeviceSet set;
    set.force.reset(puppet);
    return set;
  }
  explicit PuppetBench(const std::function<void(ForceCapabilities&)>& change = {})
      : bench(
            [&] {
              if (change) change(device->caps);
              return with(device);
            }(),
            sphere_scene()) {
    device->position = Vec3(0, 0, 0.2);
  }
  PlacementReport place(const Placement& placement, std::uint32_t id = 1) {
    bench.channels.placement.put({id, placement, false});
    bench.run();
    return report();
  }
  PlacementReport report() {
    PlacementReport now;
    bench.channels.placed.take(now);
    return now;
  }
  bool arm() {
    bench.arm();
    return bench.run(600).device.gate_state == GateState::armed;
  }
  Vec3 finger() { return bench.run().tick.input.finger.position; }
};

/// The finger's centre touches a 40 mm sphere from here.
double top_m() { return 0.040 + Preset{}.finger.radius_m; }

SessionOptions without_thread() {
  SessionOptions options;
  options.threaded = false;
  options.history_s = 1.0;
  return options;
}

}  // namespace

TEST_CASE("a placed scene is felt at the device turned, as strong, and scale times as stiff") {
  PuppetBench b;
  // Device +x is the scene's +y; 100 mm of the device are 50 of the scene.
  const Placement placement{.scale = 0.5, .rotation = kQuarter, .offset_m = Vec3(0.001, 0.002, 0.0)};
  CHECK(b.place(placement).placement == placement);
  const auto at = [&](double depth_m) {  // along the scene's +y
    b.device->position = placement.to_device(Vec3(0.0, top_m() - depth_m, 0.0));
    const ServoRecord r = b.bench.run();
    return r;
  };
  at(-1e-3);
  REQUIRE(b.arm());
  ServoRecord r;
  double depth = -1e-3;
  for (int i = 0; i <= 150; ++i) r = at(depth = -1e-3 + 20e-6 * i);
  for (int i = 0; i < 300; ++i) r = at(depth);
  REQUIRE(r.device.gate_state == GateState::armed);
  CHECK(glm::length(r.tick.input.finger.position - Vec3(0.0, top_m() - depth, 0.0)) < 1e-12);
  const Vec3 sent = b.device->commands.back().force_n, made = r.tick.output.force_n;
  CHECK(made.y == approx(Preset{}.force.stiffness_n_per_m * depth).epsilon(0.01));
  CHECK(sent.x == approx(made.y).epsilon(1e-6));
  CHECK(std::abs(sent.y) + std::abs(sent.z) < 0.02 * sent.x);
  // The record is in the scene.
  CHECK(glm::length(r.device.force_command_n - made) < 1e-6);
  // Half as stiff: the device moves twice as far for the same force.
  const double dx = placement.to_device(Vec3(0.0, top_m(), 0.0)).x - b.device->position.x;
  MESSAGE("800 N/m at scale 0.5: " << sent.x / dx << " N/m at the device, " << sent.x << " N");
  CHECK(sent.x / dx == approx(0.5 * Preset{}.force.stiffness_n_per_m).epsilon(0.01));
}

TEST_CASE("limits are the device's: its workspace and peak stay where they are under every placement") {
  PuppetBench b([](ForceCapabilities& can) { can.workspace_half_size_m = Vec3(0.1); });
  b.device->position = Vec3(0.0, 0.0, 0.09);
  b.place({.scale = 10.0, .offset_m = Vec3(0.0, 0.0, 5.0)});
  CHECK(b.bench.run().device.in_the_way == ArmingObstacle::none);
  b.device->position = Vec3(0.0, 0.0, 0.101);
  CHECK(b.bench.run(2).device.in_the_way == ArmingObstacle::outside);
}

TEST_CASE("a device's frame is between it and the placement, and a finger it doesn't sense is the world's default") {
  const DeviceFrame frame{kQuarter, Vec3(0.0, 0.0, 0.3)};
  const Placement placement{.scale = 2.0, .rotation = glm::angleAxis(1.0, Vec3(1.0, 0.0, 0.0))};
  for (const bool senses : {false, true}) {
    PuppetBench b([&](ForceCapabilities& can) {
      can.frame = frame;
      can.senses_rotation = {senses, senses, senses};
    });
    b.device->position = Vec3(0.1, 0.0, 0.0);
    const PlacementReport got = b.place(placement);
    CHECK(got.placement.scale == 2.0);
    const ServoRecord r = b.bench.run();
    CHECK(glm::length(r.tick.input.finger.position - placement.to_scene(Vec3(0.0, 0.1, 0.3))) < 1e-14);
    const Quat wanted = senses ? placement.rotation * kQuarter : placement.rotation;
    CHECK(std::abs(glm::dot(r.tick.input.finger.orientation, wanted)) == approx(1.0).epsilon(1e-14));
  }
}

TEST_CASE("a placement is refused while force is sent, taken after a stop, and arming asks its conditions anew") {
  PuppetBench b;
  REQUIRE(b.arm());
  const Placement deep{.offset_m = Vec3(0.0, 0.0, -0.2 + top_m() - 5e-3)};  // the finger is 5 mm in
  PlacementReport got = b.place(deep, 7);
  CHECK(got.id == 7);
  CHECK(got.refused);
  CHECK(got.placement == Placement{});
  b.bench.channels.stop = true;
  got = b.place(deep, 8);  // in the same tick as the stop
  CHECK_FALSE(got.refused);
  CHECK(got.placement == deep);
  CHECK(b.bench.run().tick.output.penetration_m == approx(5e-3).epsilon(0.01));
  b.bench.arm();
  const ServoRecord r = b.bench.run(100);
  CHECK(r.device.gate_state == GateState::disarmed);
  CHECK(r.device.in_the_way == ArmingObstacle::finger_at_depth);
  for (const ForceCommand& c : b.device->commands) CHECK(c.force_n == Vec3(0.0));
}

TEST_CASE("while the clutch is held the device moves and the finger stays, nothing arms, and it goes on from there") {
  for (const bool by_button : {false, true}) {
    PuppetBench b([](ForceCapabilities& can) { can.buttons = 1; });
    const Placement first{.scale = 2.0, .rotation = kQuarter};
    b.place(first);
    const auto hold = [&](bool held) {
      if (by_button)
        b.device->buttons = held ? 1 : 0;
      else
        b.bench.channels.clutch = held;
      b.bench.run();
    };
    const Vec3 held = b.finger();
    hold(true);
    b.bench.run();
    CHECK(b.report().clutched);
    for (int i = 0; i < 50; ++i) {
      b.device->position += Vec3(1e-3, -2e-3, 0.5e-3);
      CHECK(glm::length(b.finger() - held) < 1e-13);
    }
    b.bench.arm();
    const ServoRecord waits = b.bench.run(50);
    CHECK(waits.device.in_the_way == ArmingObstacle::clutched);
    CHECK(waits.device.gate_state == GateState::disarmed);
    hold(false);
    CHECK(glm::length(b.finger() - held) < 1e-13);
    const PlacementReport now = b.report();
    CHECK_FALSE(now.clutched);
    CHECK(now.placement.scale == first.scale);
    CHECK(now.placement.rotation == first.rotation);
    b.device->position += Vec3(1e-3, 0.0, 0.0);
    CHECK(glm::length(b.finger() - held - Vec3(0.0, 2e-3, 0.0)) < 1e-13);
    CHECK(b.bench.run(600).device.gate_state == GateState::armed);
    hold(true);  // too late: force is sent
    b.device->position += Vec3(1e-3, 0.0, 0.0);
    CHECK(glm::length(b.finger() - held - Vec3(0.0, 4e-3, 0.0)) < 1e-13);
    CHECK(b.bench.run().device.gate_state == GateState::armed);
  }
}

TEST_CASE("a simulated hand goes on through a clutch, is not thrown by it, and comes back to its path") {
  DeviceSet devices = simulated();
  REQUIRE(open_devices(devices));
  TickBench b(std::move(devices), sphere_scene());
  REQUIRE(b.run(400).device.force_state == DeviceState::ready);
  const Vec3 held = b.run().tick.input.finger.position;
  b.channels.clutch = true;
  double moved = 0.0;
  for (int i = 0; i < 300; ++i) moved = std::max(moved, glm::length(b.run().tick.input.finger.position - held));
  MESSAGE("the finger moves " << moved * 1e6 << " um in the scene, as the clutch is pressed");
  CHECK(moved < 2e-4);
  b.channels.clutch = false;
  Vec3 last = b.run().tick.input.finger.position;
  double fastest = 0.0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 now = b.run().tick.input.finger.position;
    fastest = std::max(fastest, glm::length(now - last) * 1e3);
    last = now;
  }
  MESSAGE("after the clutch the hand moves at most " << fastest << " m/s");
  CHECK(fastest < 1.5);
  const ServoRecord r = b.run();
  CHECK(glm::length(r.tick.input.finger.position - r.device.hand_target_m) < 5e-3);
}

TEST_CASE("the session says why a scene can't be placed now, and what to do") {
  auto made = Session::create(sphere_scene(), Preset{}, without_thread());
  REQUIRE(made);
  Session& session = **made;
  REQUIRE(session.start());
  session.advance(1500);
  REQUIRE(session.status().servo.gate_state == GateState::armed);
  const Status refused = session.place({.scale = 2.0});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().message().find("stop first (Escape") != std::string::npos);
  CHECK_FALSE(session.hold_clutch(true));
  CHECK_FALSE(session.fit_to_workspace());
  session.stop();
  session.advance(2);
  CHECK(session.hold_clutch(true));
  session.advance(2);
  CHECK(session.status().clutched);
  CHECK(session.hold_clutch(false));
  session.advance(2);
  CHECK_FALSE(session.status().clutched);
  CHECK_FALSE(session.place({.scale = 0.0}));
  CHECK(session.place({.scale = 2.0}));
  session.advance(2);
  CHECK(session.status().placement.scale == 2.0);
  CHECK_FALSE(session.status().placement_refused);

  SessionOptions no_device = without_thread();
  no_device.devices.force = "none";
  auto without = Session::create(sphere_scene(), Preset{}, no_device);
  REQUIRE(without);
  CHECK_FALSE((*without)->place({.scale = 2.0}));
}

TEST_CASE("a placement that makes the preset too stiff for the device reduces it, and a smaller one gives it back") {
  Preset preset;
  preset.force.stiffness_n_per_m = 2000.0;
  SessionOptions options = without_thread();
  options.arm_on_start = ArmOnStart::never;
  auto made = Session::create(sphere_scene(), preset, options);
  REQUIRE(made);
  Session& session = **made;
  REQUIRE(session.start());
  session.advance(200);
  const double largest = session.force_capabilities()->largest_stiffness_n_per_m;
  REQUIRE(session.place({.scale = 7.0}));
  session.advance(3);
  CHECK(session.preset().force.stiffness_n_per_m == approx(largest / 7.0));
  REQUIRE(session.place({.scale = 1.0}));
  // Until the servo has taken it, the larger of both scales holds.
  CHECK(session.preset().force.stiffness_n_per_m == approx(largest / 7.0));
  session.advance(3);
  CHECK(session.preset().force.stiffness_n_per_m == 2000.0);
}

TEST_CASE("a fitted scene, and the finger around it, is inside the device's workspace with a tenth to spare") {
  SessionOptions options = without_thread();
  options.place.fit = true;
  for (const double size : {0.004, 0.04, 4.0}) {
    auto made = Session::create(scene_of(make_icosphere(size, 2)), Preset{}, options);
    REQUIRE(made);
    REQUIRE((*made)->start());
    (*made)->advance(2);
    const Placement p = (*made)->status().placement;
    const Vec3 half = (*made)->force_capabilities()->workspace_half_size_m;
    const double around = size + pad_distance_m(Preset{}.finger);
    CHECK(p.to_device(Vec3(0.0, 0.0, around)).z == approx(0.9 * half.z).epsilon(1e-3));
    CHECK(p.to_device(Vec3(0.0, around, 0.0)).y < 0.9 * half.y);
  }
}
