#include "workbench/gui/model/time_machine.h"

#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "tests/support/meshes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

using namespace tangent;

namespace {

std::shared_ptr<const ContactScene> scene_of(const PolygonMesh& source, const ContactMeshOptions& options = {}) {
  auto mesh = ContactMesh::build(source, options);
  REQUIRE(mesh);
  auto scene = ContactScene::build(std::move(*mesh));
  REQUIRE(scene);
  return *scene;
}

std::shared_ptr<const ContactScene> torus() {
  static const auto scene = scene_of(make_torus(0.040, 0.015, 48, 24));
  return scene;
}

std::unique_ptr<Session> explored(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                  std::uint64_t ticks) {
  SessionOptions options;
  options.threaded = false;
  auto session = Session::create(std::move(scene), preset, options);
  REQUIRE(session);
  (*session)->start();
  (*session)->advance(ticks);
  return std::move(*session);
}

template <class Done>
bool wait_until(Done done) {
  for (int i = 0; i < 3000; ++i) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

TEST_CASE("the past verifies, and unchanged gains give a ghost without a different bit, with threads and without") {
  const Preset preset;
  const auto session = explored(torus(), preset, 9000);
  for (const unsigned threads : {0u, 1u, 2u}) {
    CAPTURE(threads);
    TimeMachine machine(threads);
    machine.open(session->recorded_run());
    machine.request(preset, 0.0, 9000.0);
    REQUIRE(wait_until([&] { return !machine.busy(); }));
    REQUIRE(machine.ghost());
    REQUIRE(machine.verified());
    CHECK(machine.ghost()->whole);
    CHECK(machine.ghost()->numbers.different_ticks == 0);
    CHECK(machine.verified()->numbers.different_ticks == 0);
    CHECK(machine.verified()->numbers.resolved.ticks == 9000);
    CHECK(machine.verified()->numbers.taken_over == 0);  // it was solved
    const ChannelStore& ghost = *machine.ghost()->channels;
    CHECK(ghost.end_tick() == 9000);
    for (std::uint64_t tick = 0; tick < 9000; tick += 371) {
      const TickOutput& out = session->history()[tick].tick.output;
      CHECK(ghost.value(static_cast<std::size_t>(GhostChannel::force_z), tick) == static_cast<float>(out.force_n.z));
      CHECK(ghost.value(static_cast<std::size_t>(GhostChannel::cld), tick) == static_cast<float>(out.cld_m));
      CHECK(ghost.value(static_cast<std::size_t>(GhostChannel::iterations), tick) ==
            static_cast<float>(out.iterations));
    }
  }
}

TEST_CASE("of many wishes in a row the last one is answered") {
  Preset preset;
  preset.solver.method = Method::paper;
  const auto session = explored(torus(), preset, 6000);
  TimeMachine machine(2);
  machine.open(session->recorded_run());
  Preset wish = preset;
  for (int i = 0; i < 40; ++i) {
    wish.solver.gain_curvature_m = 0.020 - 0.0004 * i;
    machine.request(wish, 0.0, 6000.0);
    if (i % 7 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  REQUIRE(wait_until([&] { return !machine.busy(); }));
  REQUIRE(machine.ghost());
  CHECK(machine.ghost()->preset == wish);
  CHECK(machine.ghost()->numbers.complete);
  CHECK(machine.ghost()->numbers.different_ticks > 0);
  machine.forget_request();
  CHECK(machine.ghost() == nullptr);
  machine.close();
  CHECK_FALSE(machine.is_open());
  machine.request(wish, 0.0, 1.0);  // there is no past
  CHECK(machine.ghost() == nullptr);
}

TEST_CASE("of a long past what is in view is answered first, then the whole") {
  const Preset preset;
  const auto session = explored(torus(), preset, 70'000);
  TimeMachine machine(1);
  machine.open(session->recorded_run());
  machine.request(preset, 60'000.0, 70'000.0);
  bool part_seen = false;
  REQUIRE(wait_until([&] {
    const auto ghost = machine.ghost();
    if (ghost && !ghost->whole) {
      part_seen = true;
      CHECK(ghost->channels->end_tick() == 70'000);
    }
    return ghost && ghost->whole;
  }));
  CHECK(machine.ghost()->numbers.resolved.ticks == 70'000);
  CHECK(machine.ghost()->numbers.different_ticks == 0);
  static_cast<void>(part_seen);  // it may have come and gone between two looks
}

namespace {

/// Time from a request to its ghost, over `wishes` requests. `change` makes the i-th one.
template <class Change>
void measure_ghosts(const std::string& name, const std::shared_ptr<const ContactScene>& scene, Preset preset,
                    int wishes, Change change) {
  const auto session = explored(scene, preset, 60'000);
  TimeMachine machine(std::max(1u, std::thread::hardware_concurrency()));
  machine.open(session->recorded_run());
  REQUIRE(wait_until([&] { return !machine.busy(); }));
  CHECK(machine.verified()->numbers.different_ticks == 0);
  std::vector<double> ms;
  Preset wish = preset;
  for (int i = 0; i < wishes; ++i) {
    change(wish, i);
    const auto began = std::chrono::steady_clock::now();
    machine.request(wish, 0.0, 60'000.0);
    while (!machine.ghost() || !(machine.ghost()->preset == wish))
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count());
  }
  std::sort(ms.begin(), ms.end());
  const auto at = [&](double share) { return ms[static_cast<std::size_t>(share * static_cast<double>(wishes - 1))]; };
  MESSAGE(name, ": least ", ms.front(), " ms, median ", at(0.5), " ms, p99 ", at(0.99), " ms, worst ", ms.back(),
          " ms; contacts taken over: ", machine.ghost()->numbers.taken_over, " of ",
          machine.ghost()->numbers.resolved.ticks);
}

}  // namespace

// How long the ghost of a minute takes. Not a test: run with --no-skip to measure.
TEST_CASE("measure: 60 s of history solved again, from the wish to the ghost" * doctest::skip()) {
  const auto drag_gain = [](Preset& wish, int i) {
    wish.solver.gain_curvature_m = 0.020 - 0.00004 * (i + 1);
    wish.force.stiffness_n_per_m = 800.0 - i;
  };
  const auto drag_tolerance = [](Preset& wish, int i) { wish.solver.tolerance_m = 1e-6 * (1.0 - 0.001 * (i + 1)); };
  Preset paper;
  paper.solver.method = Method::paper;
  const auto measure = [&](const std::string& name, const std::shared_ptr<const ContactScene>& scene, int solved) {
    measure_ghosts(name + ", robust, gain", scene, Preset{}, 300, drag_gain);
    measure_ghosts(name + ", robust, tolerance", scene, Preset{}, solved, drag_tolerance);
    measure_ghosts(name + ", paper, gain", scene, paper, 10, drag_gain);
  };
  measure("torus", torus(), 300);
  measure("rounded cube", scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3})), 300);
  const std::filesystem::path bunny = testing::shared_file("meshes/stanford-bunny.obj");
  if (!std::filesystem::exists(bunny)) return;
  measure("bunny", scene_of(*read_mesh(bunny, 1.0), {.fit_m = 0.08}), 10);
}
