// Random poses on every hard case: whatever comes in, nothing that is not a number goes out, and robust has an answer.
#include "tests/core/scenes.h"
#include "workbench/bench/bench_case.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

using namespace tangent;
using namespace tangent::bench;
using tangent::test::Random;

namespace {

/// Of each case. TANGENT_RANDOM_POSES asks for another number, TANGENT_RANDOM_CASE for one case alone: a million of
/// each takes hours.
long pose_count() {
  if (const char* wanted = std::getenv("TANGENT_RANDOM_POSES")) return std::max(1L, std::atol(wanted));
  return test::rounds(1000);
}

bool wanted(const BenchCase& c) {
  const char* name = std::getenv("TANGENT_RANDOM_CASE");
  return !name || c.name == name;
}

struct Counts {
  bool built = false;
  long ticks = 0;
  long not_finite = 0;    ///< output or kept state
  long not_unit = 0;      ///< normals
  long untrue = 0;        ///< converged by name, but with an error over the tolerance or a force over the limit
  long unconverged = 0;
};

bool kept_is_finite(const TickState& s) {
  return is_finite(s.plane.point) && is_finite(s.plane.normal) && std::isfinite(s.plane.u) && std::isfinite(s.plane.v) &&
         std::isfinite(s.plane.turn) && is_finite(s.last_converged.point) && is_finite(s.last_converged.normal);
}

/// Anywhere around, on and in the mesh, turned anyhow; every fourth pose is a leap, the others go on from there.
Counts random_poses(const BenchCase& c, long poses, std::uint64_t seed) {
  Counts counts;
  const Result<bench::ScenePtr> scene = build_scene(c);
  if (!scene) return counts;
  counts.built = true;
  const Box& box = (*scene)->mesh().bounds();
  const Vec3 half = 0.5 * box.size() + Vec3(c.preset.finger.reach_m());
  const Vec3 middle = (*scene)->mesh().origin() + box.centre();
  const double size = glm::length(box.size());
  Random random(seed);
  Stepper stepper(*scene);
  TickState state;
  Vec3 centre(0.0);
  for (; counts.ticks < poses; ++counts.ticks) {
    centre = counts.ticks % 4 ? centre + random.in_cube(0.002 * size) : half * random.in_cube(1.0);
    const TickInput input{1e-3 * static_cast<double>(counts.ticks), {middle + centre, random.orientation()}};
    const TickOutput out = stepper.step(c.preset, input, state);
    const bool unconverged = out.status == TickStatus::unconverged;
    counts.not_finite += !test::all_finite(out) || !kept_is_finite(state);
    counts.not_unit += !(std::abs(glm::length(out.normal) - 1.0) < 1e-9);
    counts.untrue += !unconverged && !(out.error_m < c.preset.solver.tolerance_m);
    counts.untrue += !(glm::length(out.force_n) <= c.preset.force.limit_n * (1.0 + 1e-12));
    counts.unconverged += unconverged;
  }
  return counts;
}

}  // namespace

TEST_CASE("random poses on every hard case put out no NaN, and robust has an answer to each") {
  std::vector<BenchCase> cases = hard_cases();
  std::erase_if(cases, [](const BenchCase& c) { return !wanted(c); });
  REQUIRE(!cases.empty());
  std::vector<Counts> counts(cases.size());
  std::atomic<std::size_t> next{0};
  {
    std::vector<std::jthread> workers;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
      workers.emplace_back([&] {
        for (std::size_t k = next++; k < cases.size(); k = next++) counts[k] = random_poses(cases[k], pose_count(), 100 + k);
      });
  }
  long ticks = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    CAPTURE(cases[k].name);
    CHECK(counts[k].built);
    CHECK(counts[k].not_finite == 0);
    CHECK(counts[k].not_unit == 0);
    CHECK(counts[k].untrue == 0);
    CHECK(counts[k].unconverged == 0);
    ticks += counts[k].ticks;
  }
  MESSAGE(ticks << " random poses on " << cases.size() << " hard cases");
}
