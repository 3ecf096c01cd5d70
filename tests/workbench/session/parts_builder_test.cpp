// What is built beside the servo: it arms before, says where the finger outran the building, and no bit depends on it.
#include "workbench/session/parts_builder.h"

#include "core/base/tolerances.h"
#include "tests/workbench/session/session_fixture.h"
#include "workbench/session/prepared_scene.h"
#include "workbench/session/resolve_history.h"
#include "workbench/session/session.h"
#include "workbench/session/tick_again.h"
#include "workbench/session/two_threads.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr int kInARow = 20;

/// A finger over a ball of which only what is near its top is built.
struct LateBall {
  PuppetForceDevice* device = new PuppetForceDevice;
  ScenePtr scene = late_ball();
  TickBench bench{[this] {
                    DeviceSet set;
                    set.force.reset(device);
                    return set;
                  }(),
                  scene};
  std::vector<ServoRecord> records;

  explicit LateBall(bool near_is_built) {
    go_to(0.0, -1e-3);
    if (near_is_built) build_in_reach(*scene, device->position, Finger{});
  }
  void go_to(double angle, double depth_m) {
    const double away = 0.040 + Finger{}.radius_m - depth_m;
    device->position = away * Vec3(std::sin(angle), std::cos(angle), 0.0);
  }
  ServoRecord run(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) records.push_back(bench.run());
    return records.back();
  }
  /// Pushes on top, then slips round the ball, faster than anybody builds, until a tick says so. False: none does.
  bool outrun() {
    bench.arm();
    run(600);
    for (int i = 0; i < 100; ++i) {
      go_to(0.0, 1e-5 * i);
      run();
    }
    // Single ticks may miss what a search that looks far ahead wants to know, and the next one does with less.
    for (int i = 0, in_a_row = 0; i < 700; ++i) {
      go_to(0.004 * i, 1e-3);
      in_a_row = run().tick.input.unready ? in_a_row + 1 : 0;
      if (in_a_row == kInARow) return true;
    }
    return false;
  }
};

}  // namespace

TEST_CASE("the servo arms when what is in reach is built, and waits where it is not") {
  LateBall ready(true), waiting(false);
  const std::size_t unbuilt = ready.scene->unbuilt_parts();
  CHECK(unbuilt > 0);
  ready.bench.arm();
  CHECK(ready.run(600).device.gate_state == GateState::armed);
  CHECK(ready.scene->unbuilt_parts() == unbuilt);
  for (const ServoRecord& r : ready.records) CHECK_FALSE(r.tick.input.unready);

  waiting.bench.arm();
  const ServoRecord held = waiting.run(600);
  CHECK(held.tick.input.unready);
  CHECK(held.device.in_the_way == ArmingObstacle::unready);
  CHECK(held.device.gate_state == GateState::disarmed);
  build_in_reach(*waiting.scene, waiting.device->position, Finger{});
  CHECK(waiting.run(600).device.gate_state == GateState::armed);
}

TEST_CASE("a finger that outruns the building feels the last contact fade, and the surface fade in when it is built") {
  LateBall b(true);
  REQUIRE(b.outrun());
  const std::size_t unbuilt = b.scene->unbuilt_parts(), first = b.records.size() - kInARow;
  const double pushed_n = glm::length(b.records[first - 1].tick.output.force_n);
  CHECK(pushed_n > 0.5);
  b.run(300);
  CHECK(b.scene->unbuilt_parts() == unbuilt);  // not by the servo
  for (std::size_t i = first; i < b.records.size(); ++i) {
    const TickRecord& now = b.records[i].tick;
    CHECK(now.input.unready);
    CHECK(now.output.status == TickStatus::unconverged);
    // The finger goes on by 0.24 mm, the old plane does not.
    CHECK(glm::length(now.output.force_n) <= pushed_n + Preset{}.force.stiffness_n_per_m * 0.24e-3);
    if (i >= first + kInARow) CHECK(now.output.force_n == Vec3(0.0));
  }
  CHECK(b.records.back().tick.output.force_n == Vec3(0.0));

  b.scene->build_far_parts(run_in_turn);
  for (int i = 0; i < 300; ++i) {
    const Vec3 before = b.records.back().tick.output.force_n;
    const ServoRecord now = b.run();
    CHECK_FALSE(now.tick.input.unready);
    CHECK(is_converged(now.tick.output.status));
    CHECK(glm::length(now.tick.output.force_n - before) <= kForceFade * (1.0 + 1e-3 * (i + 1)) * 1e-3 + 1e-9);
  }
  CHECK(glm::length(b.records.back().tick.output.force_n) > 0.9 * pushed_n);
}

TEST_CASE("ticks recorded while parts were built are the same bits when they are computed again") {
  LateBall b(true);
  REQUIRE(b.outrun());
  b.run(20);
  while (b.scene->build_next_part(b.device->position)) b.run();
  b.run(20);
  TickAgain again;
  IterationTrace trace;
  std::size_t differ = 0, unready = 0;
  for (const ServoRecord& r : b.records) {
    differ += !same_bits(again.step(b.scene, Preset{}, r, trace), r.tick.output);
    unready += r.tick.input.unready;
  }
  CHECK(differ == 0);
  CHECK(unready > 20);
  CHECK(unready < b.records.size());
}

TEST_CASE("a session builds the rest beside its servo, and without a thread before its first tick") {
  SessionOptions options;
  options.servo.realtime = false;
  options.history_s = 1.0;
  const ScenePtr late = late_ball(), other = late_ball();
  auto session = Session::create(late, Preset{}, options);
  REQUIRE(session);
  REQUIRE((*session)->start());
  const auto built = [&](const ContactScene& scene) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (scene.unbuilt_parts() > 0 && std::chrono::steady_clock::now() < until) {
      (*session)->poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return scene.unbuilt_parts() == 0;
  };
  CHECK(built(*late));
  (*session)->set_scene(other);
  CHECK(built(*other));
  REQUIRE((*session)->shut_down());

  options.threaded = false;
  const ScenePtr at_once = late_ball();
  auto unthreaded = Session::create(at_once, Preset{}, options);
  REQUIRE(unthreaded);
  CHECK(at_once->unbuilt_parts() == 0);
}

TEST_CASE("a builder that is let go of stops, and what it built stays") {
  const ScenePtr scene = late_ball();
  const std::size_t parts = scene->unbuilt_parts();
  {
    PartsBuilder builder(scene, Vec3(0.0, 0.06, 0.0));
    builder.finger_is_at(Vec3(0.0, -0.06, 0.0));
  }
  CHECK(scene->unbuilt_parts() <= parts);
  PartsBuilder builder(scene, Vec3(0.0));
  while (!builder.done()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(scene->unbuilt_parts() == 0);
}

TEST_CASE("measure: from five million triangles to a force" * doctest::skip()) {
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&begin] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const PolygonMesh source = make_icosphere(0.040, 9);
  const double made = seconds();
  auto mesh = ContactMesh::build(source, {}, run_on_two_threads);
  REQUIRE(mesh);
  const auto scene = ContactScene::build(std::move(*mesh), {.far_parts = false}, run_on_two_threads);
  REQUIRE(scene);
  const double built = seconds();
  PreparedScenePtr prepared = Session::prepare(*scene, Finger{});
  const double with_path = seconds();
  build_in_reach(**scene, prepared->path.at(0.0, pad_distance_m(Finger{}), 0.0).position_m, Finger{});
  const double in_reach = seconds();
  auto session = Session::create(*scene, Preset{}, {}, std::move(prepared));
  REQUIRE(session);
  REQUIRE((*session)->start());
  while ((*session)->status().servo.gate_state != GateState::armed && seconds() < 60.0) {
    (*session)->poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  MESSAGE("mesh and scene " << built - made << " s, path of the hand " << with_path - built << ", parts in reach "
                            << in_reach - with_path << ", armed after another " << seconds() - in_reach);
  CHECK((*session)->status().servo.gate_state == GateState::armed);
  REQUIRE((*session)->shut_down());
}
