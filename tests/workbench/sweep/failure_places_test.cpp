#include "workbench/sweep/failure_places.h"

#include "tests/workbench/sweep/ground_fixture.h"
#include "workbench/sweep/cell_numbers.h"

#include <algorithm>

namespace tangent::sweep {
namespace {

using testing::paper_preset;
using testing::torus_ground;

TEST_CASE("failures by triangle are those of the cells, all of them, and none where nothing fails") {
  const Ground ground = torus_ground(600);
  const std::vector<Preset> presets{paper_preset(0.0), paper_preset(0.004), paper_preset(0.02)};
  std::uint64_t expected = 0;
  for (const Preset& preset : presets) {
    Stepper stepper(ground.scene), exact(ground.scene);
    const CellNumbers numbers = *measure_cell(stepper, exact, preset, *ground.motion);
    expected += numbers.unconverged + numbers.facing;
  }
  CHECK(expected > 0);
  const auto found = failure_places(ground, presets);
  REQUIRE(found);
  CHECK(found->size() == ground.scene->mesh().triangle_count());
  std::uint64_t failed = 0, ticks = 0;
  for (const TicksThere& there : *found) {
    CHECK(there.failed <= there.ticks);
    failed += there.failed, ticks += there.ticks;
  }
  CHECK(failed == expected);
  CHECK(ticks == presets.size() * ground.motion->size());
  Preset robust;
  robust.solver.method = Method::robust;
  const std::vector<Preset> good{robust};
  const auto none = failure_places(ground, good);
  REQUIRE(none);
  CHECK(std::all_of(none->begin(), none->end(), [](const TicksThere& there) { return there.failed == 0; }));
}

TEST_CASE("failures are looked for in the background, and not when told to stop") {
  const Ground ground = torus_ground(300);
  const std::vector<Preset> presets{paper_preset(0.0)};
  CHECK_FALSE(failure_places(ground, presets, [] { return true; }));
  FailurePlacesJob job;
  CHECK_FALSE(job.running());
  job.start(ground, presets, false);
  const auto here = job.take();
  REQUIRE(here);
  CHECK_FALSE(job.take());
  job.start(ground, presets, true);
  std::optional<std::vector<TicksThere>> there;
  while (!there) there = job.take();
  CHECK(*there == *here);
  CHECK_FALSE(job.running());
  job.start(torus_ground(5000), std::vector<Preset>(50, paper_preset(0.0)), true);
  job.cancel();
  CHECK_FALSE(job.take());
}

}  // namespace
}  // namespace tangent::sweep
