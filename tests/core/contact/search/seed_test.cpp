// What a search for a start costs where it finds none.
#include "core/contact/search/seed.h"

#include "core/contact/context.h"
#include "tests/core/recorded_scenes.h"

using namespace tangent;
using namespace tangent::test;

TEST_CASE("where the steps of a staircase offer no contact a tick in motion tries no start in vain twice") {
  const RecordedScene recorded = recorded_scene("staircase");
  const Preset preset = sphere_preset(0.020, Method::robust);
  Stepper stepper(recorded.scene);
  TickState state;
  int facing = 0, most = 0, told = 0;
  for (const TickInput& input : recorded.poses) {
    const TickOutput out = stepper.step(preset, input, state);
    if (out.status != TickStatus::facing) continue;
    if (facing++ % 50 == 0) {  // of the same pose alone: the last record is the place that is shown
      const auto trace = std::make_unique<IterationTrace>();
      const TickOutput alone = solve_once(recorded.scene, preset, input.finger, trace.get());
      REQUIRE(trace->size > 0);
      const IterationRecord& last = trace->records[trace->size - 1];
      CHECK((last.stop == StopReason::facing) == (alone.status == TickStatus::facing));
      CHECK(last.error_m == alone.error_m);
      told += last.stop == StopReason::facing;
    }
    if (out.event != TickEvent::first) most = std::max(most, out.iterations);
  }
  MESSAGE(facing << " ticks without a contact, of " << most << " evaluations at most");
  CHECK(facing > 300);
  CHECK(told > 3);
  CHECK(most <= 450);  // 897 when all nearest triangles were tried, each twice
}

TEST_CASE("a search after one in vain finds the same start, where there is one and where there is none") {
  const RecordedScene recorded = recorded_scene("staircase");
  const ContactMesh& mesh = recorded.scene->mesh();
  const SolverSettings settings = sphere_preset(0.020, Method::robust).solver;
  const Finger finger = sphere_preset(0.020, Method::robust).finger;
  int facing = 0, different = 0, evaluations = 0, evaluations_in_vain = 0;
  PatchCache cache(mesh);
  for (std::size_t i = 0; i < recorded.poses.size(); i += 3) {
    const FingerPose pose{recorded.poses[i].finger.position - mesh.origin(), recorded.poses[i].finger.orientation};
    ContactContext context{cache, settings, finger, pose, mesh.origin()};
    context.moved_m = 1e-4;
    const SeedResult one = seed_contact(context, recorded.scene->search(), {});
    const SeedResult other = seed_contact(context, recorded.scene->search(), {}, true);
    facing += one.best.facing();
    evaluations += one.evaluations;
    evaluations_in_vain += other.evaluations;
    different += one.found != other.found || one.best.facing() != other.best.facing() ||
                 one.best.plane.point != other.best.plane.point || one.best.plane.normal != other.best.plane.normal ||
                 one.best.contact.penetration_m != other.best.contact.penetration_m;
  }
  CHECK(facing > 50);
  CHECK(facing < static_cast<int>(recorded.poses.size() / 3));
  CHECK(different == 0);
  CHECK(evaluations_in_vain <= 1.2 * evaluations);
}
