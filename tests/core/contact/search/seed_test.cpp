// What a search for a start costs where it finds none.
#include "tests/core/recorded_scenes.h"

using namespace tangent;
using namespace tangent::test;

TEST_CASE("where the steps of a staircase offer no contact a tick in motion tries no start in vain twice") {
  const RecordedScene recorded = recorded_scene("staircase");
  const Preset preset = sphere_preset(0.020, Method::robust);
  Stepper stepper(recorded.scene);
  TickState state;
  int facing = 0, most = 0;
  for (const TickInput& input : recorded.poses) {
    const TickOutput out = stepper.step(preset, input, state);
    if (out.status != TickStatus::facing) continue;
    ++facing;
    if (out.event != TickEvent::first) most = std::max(most, out.iterations);
  }
  MESSAGE(facing << " ticks without a contact, of " << most << " evaluations at most");
  CHECK(facing > 300);
  CHECK(most <= 450);  // 897 when all nearest triangles were tried, each twice
}
