// A servo tick does not allocate: counted at malloc itself, of this program and its libraries.
#include "devices/plugin/host/allocation_watch.h"
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the count of allocations counts") {
  count_allocations();
  ::operator delete(::operator new(8));
  void* volatile memory = std::malloc(8);
  std::free(memory);
  CHECK(counted_allocations() == 2);
}

TEST_CASE(
    "no tick allocates: homing, contact, other methods, a preset that is new or undone, a new scene, a full ring") {
  TickBench bench(simulated(), torus_scene());
  REQUIRE(bench.devices.force->open());
  REQUIRE(bench.devices.display->open());
  bench.arm();
  bench.channels.recorder_attached = true;
  std::uint64_t in_ticks = 0;
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const TickTiming timing = bench.pacer.begin(bench.pacer.deadline_ns());
      count_allocations();
      bench.tick->run(timing);
      in_ticks += counted_allocations();
    }
  };
  run(2000);
  std::uint32_t id = 0;
  for (const Method method : {Method::paper, Method::newton, Method::robust, Method::facet, Method::force_shading}) {
    Preset preset;
    preset.solver.method = method;
    bench.channels.presets.put({++id, preset});
    run(300);
  }
  Preset shaking;
  shaking.force.stiffness_n_per_m = 80e3;
  bench.channels.hand.put({.settings = {.press_m = 8e-3}});
  bench.channels.presets.put({++id, shaking, true});
  run(3000);
  PresetUndone undone;
  CHECK(bench.channels.undone.take(undone));
  bench.channels.scenes.offer(std::make_unique<PreparedScene>(sphere_scene(), Finger{}));
  run(2000);
  bench.channels.hand.put({.settings = {.mode = HandMode::point}, .point_m = Vec3(0.2, 0.1, 0.0)});
  bench.channels.force.put(ForceSwitch::stop);
  run(500);
  const ScenePtr late = late_ball();
  auto prepared = std::make_unique<PreparedScene>(late, Finger{});
  const std::size_t unbuilt = late->unbuilt_parts();  // its hierarchy
  bench.channels.hand.put({});
  bench.channels.scenes.offer(std::move(prepared));
  run(500);
  CHECK(late->unbuilt_parts() == unbuilt);
  CHECK(bench.channels.gui.drops() > 0);
  CHECK(in_ticks == 0);
}
