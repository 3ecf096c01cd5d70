#include "core/lab/measure/scene_statistics.h"
#include "workbench/bench/bench_case.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

using namespace tangent;
using namespace tangent::bench;

namespace {

// The benchmark runs more ticks: `workbench bench --suite hard`. TANGENT_HARD_TICKS sets their number here.
int tick_count() {
  if (const char* wanted = std::getenv("TANGENT_HARD_TICKS")) return std::max(1, std::atoi(wanted));
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
  return 100;
#else
  return 2500;
#endif
}

void expect_solved(const BenchCase& c) {
  CAPTURE(c.name);
  const Result<ScenePtr> scene = build_scene(c);
  REQUIRE_MESSAGE(scene.has_value(), (scene ? "" : scene.error().message()));
  const auto poses = c.poses(**scene, c.preset.finger, tick_count());
  REQUIRE(poses);
  REQUIRE(poses->size() == static_cast<std::size_t>(tick_count()));
  Stepper stepper(*scene);
  TickState state;
  std::vector<TickOutput> outputs;
  for (const TickInput& input : *poses) outputs.push_back(stepper.step(c.preset, input, state));
  const RunStatistics s = run_statistics(*poses, outputs, {});
  CAPTURE(s.first_unconverged);
  CHECK(s.unconverged() == 0);
  CHECK(s.not_finite == 0);
  CHECK(s.max_error_m <= c.preset.solver.tolerance_m);
}

}  // namespace

TEST_CASE("there are at least 25 hard cases, each with a name of its own and a reason") {
  std::set<std::string> names;
  for (const BenchCase& c : hard_cases()) {
    CAPTURE(c.name);
    CHECK(names.insert(c.name).second);
    CHECK_FALSE(c.what.empty());
    CHECK(c.preset.solver.method == Method::robust);
  }
  CHECK(names.size() >= 25);
}

TEST_CASE("robust solves every tick of every hard case") {
  for (const BenchCase& c : hard_cases()) expect_solved(c);
}

// The way runs exactly in the corner's plane of symmetry, where no step of the contact leads out of the vertex.
TEST_CASE("round the corner of a cube every contact is as deep as the raw mesh's") {
  for (const BenchCase& c : hard_cases()) {
    if (c.name != "cube_corner") continue;
    const Result<ScenePtr> scene = build_scene(c);
    REQUIRE(scene);
    const auto poses = c.poses(**scene, c.preset.finger, 2500);
    REQUIRE(poses);
    Preset flat = c.preset;
    flat.solver.method = Method::facet;
    Stepper smooth_stepper(*scene), flat_stepper(*scene);
    TickState smooth_state, flat_state;
    int wrong = 0;
    for (const TickInput& input : *poses) {
      const double smooth = smooth_stepper.step(c.preset, input, smooth_state).penetration_m;
      wrong += std::abs(smooth - flat_stepper.step(flat, input, flat_state).penetration_m) >
               c.preset.solver.switch_hysteresis_m;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("robust solves every tick of the paper's objects") {
  for (const BenchCase& c : paper_cases()) expect_solved(c);
}

TEST_CASE("the same case gives the same poses") {
  for (const BenchCase& c : hard_cases()) {
    CAPTURE(c.name);
    const Result<ScenePtr> scene = build_scene(c);
    REQUIRE(scene);
    const auto a = c.poses(**scene, c.preset.finger, 40), b = c.poses(**scene, c.preset.finger, 40);
    REQUIRE((a && b));
    bool same = true;
    for (std::size_t i = 0; i < a->size(); ++i) {
      same = same && (*a)[i].finger.position == (*b)[i].finger.position && (*a)[i].t_s == (*b)[i].t_s;
      CHECK(is_finite((*a)[i].finger.position));
    }
    CHECK(same);
  }
}
