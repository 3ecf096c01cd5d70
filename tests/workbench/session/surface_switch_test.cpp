// The surface taken away and put back, and the pull while it is away, through the safety gate.
#include "workbench/session/surface_switch.h"

#include "devices/simulated/simulated_force_device.h"
#include "tests/workbench/session/session_fixture.h"

namespace tangent {
namespace {

using test::PuppetForceDevice;
using test::sphere_scene;
using test::TickBench;

constexpr double kJitter_n = 1e-4;  // of the puppet's 2 um along the surface

/// A puppet on the sphere of 40 mm, armed in the air.
struct OnSphere {
  PuppetForceDevice* puppet = nullptr;
  std::unique_ptr<TickBench> bench;
  OnSphere() {
    DeviceSet devices;
    auto made = std::make_unique<PuppetForceDevice>();
    puppet = made.get();
    puppet->position = height(3e-3);
    // Held by a hand: one that reads the same for long is taken for frozen.
    puppet->before = [](PuppetForceDevice& p) { p.position.x = p.commands.size() % 2 == 0 ? 0.0 : 2e-6; };
    devices.force = std::move(made);
    bench = std::make_unique<TickBench>(std::move(devices), sphere_scene());
    bench->arm();
    bench->run(300);
  }
  /// Of the finger's pad over the surface.
  static Vec3 height(double m) { return {0.0, 0.0, 0.060 + m}; }
  ServoRecord to(double m, int ticks = 50) {
    const Vec3 from = puppet->position;
    for (int i = 1; i < ticks; ++i) {
      puppet->position = from + (height(m) - from) * (i / static_cast<double>(ticks));
      bench->run();
    }
    puppet->position = height(m);
    return bench->run();
  }
  void wish(const SurfaceWish& wish) { bench->channels.surface.put(wish); }
};

TEST_CASE("a surface that is taken away fades out tick by tick, and nothing is left") {
  OnSphere on;
  double before = glm::length(on.to(-2e-3).device.force_command_n);
  REQUIRE(before > 1.0);
  const double most = before / (1000.0 * kSurfaceFade_s) + kJitter_n;
  on.wish({.felt = false});
  for (int i = 0; i < 110; ++i) {
    const double now = glm::length(on.bench->run().device.force_command_n);
    CHECK(now <= before + kJitter_n);
    CHECK(before - now <= most);
    before = now;
  }
  const ServoRecord away = on.bench->run();
  CHECK(away.device.surface_share == 0.0F);
  CHECK(away.device.force_command_n == Vec3(0.0));
  CHECK(glm::length(away.tick.output.force_n) > 1.0);  // what is computed stays, and replays
}

TEST_CASE("it comes back once the finger is off it, and not before") {
  OnSphere on;
  on.to(-2e-3);
  on.wish({.felt = false});
  on.bench->run(150);
  on.wish({});
  for (int i = 0; i < 200; ++i) {
    const ServoRecord waits = on.bench->run();
    CHECK(waits.device.surface_waits == 1);
    CHECK(waits.device.force_command_n == Vec3(0.0));
  }
  CHECK(on.to(1e-3).device.surface_share == 1.0F);
  CHECK(on.bench->run(400).device.gate_state == GateState::armed);
  CHECK(glm::length(on.to(-2e-3).device.force_command_n) > 1.0);
}

TEST_CASE("a wish to have it back while it fades does not push") {
  OnSphere on;
  double before = glm::length(on.to(-2e-3).device.force_command_n);
  on.wish({.felt = false});
  on.bench->run(30);
  on.wish({});
  for (int i = 0; i < 100; ++i) {
    const double now = glm::length(on.bench->run().device.force_command_n);
    CHECK(now <= before + kJitter_n);
    before = now;
  }
  CHECK(before == 0.0);
}

TEST_CASE("a surface that nobody is to feel keeps nobody from arming") {
  OnSphere on;
  on.wish({.felt = false});
  on.bench->channels.stop.store(true);
  on.bench->run(5);
  on.to(-5e-3);
  on.bench->arm();
  const ServoRecord armed = on.bench->run(400);
  CHECK(armed.device.gate_state == GateState::armed);
  CHECK(armed.device.force_command_n == Vec3(0.0));
}

/// A finger that nobody holds but the pull, with the resistance of the air around a hand.
class LooseFinger final : public ForceDevice {
 public:
  explicit LooseFinger(const Vec3& at) : device_(options()) { device_.place({at}); }
  const ForceCapabilities& capabilities() const override { return device_.capabilities(); }
  Status open() override { return device_.open(); }
  void close() override { device_.close(); }
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override {
    return device_.exchange(command, dt_s);
  }

 private:
  static SimulatedForceOptions options() {
    SimulatedForceOptions out;
    out.hand_stiffness_n_per_m = 0.0;
    out.hand_damping_n_s_per_m = 4.0;
    return out;
  }
  SimulatedForceDevice device_;
};

TEST_CASE("the pull draws a finger to its place, no stronger than its limit, and the gate takes it for what it is") {
  for (const double far_m : {0.02, 0.06, 0.09}) {
    DeviceSet devices;
    devices.force = std::make_unique<LooseFinger>(Vec3(far_m, 0.0, 0.07));
    REQUIRE(open_devices(devices));
    TickBench bench(std::move(devices), sphere_scene());
    bench.channels.surface.put({false, true, Vec3(0.0, 0.0, 0.07), 30.0, 1.0});
    bench.arm();
    for (int i = 0; i < 4000; ++i) {
      const ServoRecord record = bench.run();
      CHECK(glm::length(record.device.force_command_n) <= 1.0 + 1e-9);
      CHECK(record.device.gate_fault == GateFault::none);
    }
    const ServoRecord there = bench.run();
    CHECK(glm::length(there.tick.input.finger.position - Vec3(0.0, 0.0, 0.07)) < 5e-3);
  }
}

}  // namespace
}  // namespace tangent
