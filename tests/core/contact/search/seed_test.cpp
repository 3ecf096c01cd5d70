// What a search for a start costs where it finds none.
#include "core/contact/search/seed.h"

#include "core/contact/context.h"
#include "tests/core/recorded_scenes.h"

using namespace tangent;
using namespace tangent::test;

namespace {

/// A rough sheet of flat facets: from behind, where they part, some places hold no contact.
ScenePtr facets() {
  ContactMeshOptions flat;
  flat.crease_rad = 0.0;
  Random random(1);
  return scene_of(height_field(0.05, 16, [&](double, double) { return random.in(-1e-3, 1e-3); }), flat);
}

}  // namespace

TEST_CASE("deep in the steps of a staircase every tick finds a contact, and none searches for it at length") {
  const RecordedScene recorded = recorded_scene("staircase");
  const Preset preset = sphere_preset(0.020, Method::robust);
  Stepper stepper(recorded.scene);
  TickState state;
  int facing = 0, most = 0;
  for (const TickInput& input : recorded.poses) {
    const TickOutput out = stepper.step(preset, input, state);
    facing += out.status == TickStatus::facing;
    if (out.event != TickEvent::first) most = std::max(most, out.iterations);
  }
  CHECK(facing == 0);  // 478 when nothing held the ball where its centre is behind both sides of a step
  CHECK(most <= 150);
}

TEST_CASE("where there is no contact the last record of a trace is the place that is shown") {
  const ScenePtr scene = facets();
  Random random(3);
  int told = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto trace = std::make_unique<IterationTrace>();
    const FingerPose pose{{random.in(-0.04, 0.04), random.in(-0.04, 0.04), -0.012}, Quat(1.0, 0.0, 0.0, 0.0)};
    const TickOutput alone = solve_once(scene, sphere_preset(0.008, Method::robust), pose, trace.get());
    REQUIRE(trace->size > 0);
    const IterationRecord& last = trace->records[trace->size - 1];
    CHECK((last.stop == StopReason::facing) == (alone.status == TickStatus::facing));
    if (alone.status == TickStatus::facing) CHECK(last.error_m == alone.error_m);
    told += last.stop == StopReason::facing;
  }
  CHECK(told > 3);
}

TEST_CASE("a search after one in vain finds the same start, where there is one and where there is none") {
  const ScenePtr scene = facets();
  const ContactMesh& mesh = scene->mesh();
  const SolverSettings settings = sphere_preset(0.008, Method::robust).solver;
  const Finger finger = sphere_preset(0.008, Method::robust).finger;
  int facing = 0, different = 0, evaluations = 0, evaluations_in_vain = 0;
  PatchCache cache(mesh);
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at(random.in(-0.04, 0.04), random.in(-0.04, 0.04), random.in(-0.012, 0.008));
    const FingerPose pose{at - mesh.origin(), Quat(1.0, 0.0, 0.0, 0.0)};
    ContactContext context{cache, settings, finger, pose, mesh.origin()};
    context.moved_m = 1e-4;
    const SeedResult one = seed_contact(context, scene->search(), {});
    const SeedResult other = seed_contact(context, scene->search(), {}, true);
    facing += one.best.facing();
    evaluations += one.evaluations;
    evaluations_in_vain += other.evaluations;
    different += one.found != other.found || one.best.facing() != other.best.facing() ||
                 one.best.plane.point != other.best.plane.point || one.best.plane.normal != other.best.plane.normal ||
                 one.best.contact.penetration_m != other.best.contact.penetration_m;
  }
  CHECK(facing > 3);
  CHECK(facing < 500);
  CHECK(different == 0);
  CHECK(evaluations_in_vain <= 1.2 * evaluations);
}
