#include "workbench/bench/compare_methods.h"

#include "core/shading/render.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace tangent;
using namespace tangent::bench;

namespace {

MotionPart part_of_icosphere(int ticks) {
  const BenchCase bench_case = paper_cases().front();
  const auto scene = build_scene(bench_case);
  REQUIRE(scene);
  const auto poses = bench_case.poses(**scene, bench_case.preset.finger, ticks);
  REQUIRE(poses);
  return {*scene, bench_case.preset, *poses};
}

}  // namespace

TEST_CASE("every method on one motion - errors as each alone, intervals, one fastest, and a stop is nothing") {
  const MotionPart part = part_of_icosphere(60);
  const TickClock clock;
  CompareMethodsOptions options;
  options.rounds = 3;
  const auto compared = compare_methods(std::array{part, part}, clock, options);
  REQUIRE(compared);
  CHECK(compared->ticks == 120);
  CHECK(compared->rounds == 3);
  REQUIRE(compared->methods.size() == kMeasuredMethods.size());
  for (const ComparedMethod& m : compared->methods) {
    CAPTURE(to_string(m.method));
    CHECK(m.ticks == 120);
    CHECK(m.typical_ns.count == 3);
    CHECK(m.to_fastest.low <= m.to_fastest.ratio);
    CHECK(m.to_fastest.ratio <= m.to_fastest.high);
    CHECK_FALSE((m.fastest && m.tie));
    CHECK(m.tie == (!m.fastest && m.to_fastest.low < kTieRatio));
    if (!is_smooth(m.method)) {
      CHECK(m.error_m.p50 > 1e-5);
      continue;
    }
    Preset preset = part.preset;
    preset.solver.method = m.method;
    std::uint64_t lost = 0;
    const auto own = difference_from_own(
        part.scene, preset, part.poses, [] { return false; }, lost);
    CHECK(m.error_m.count == 2 * own.contact_m.count);
    CHECK(m.error_m.max == own.contact_m.max);
  }
  const auto fastest = [](const ComparedMethod& m) { return m.fastest; };
  CHECK(std::count_if(compared->methods.begin(), compared->methods.end(), fastest) == 1);
  options.stop = [] { return true; };
  CHECK_FALSE(compare_methods(std::array{part}, clock, options));
  CHECK_FALSE(compare_methods({}, clock));
}
