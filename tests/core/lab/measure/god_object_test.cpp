// The god-object to compare with, and the comparison: in a corner it and the force of all places agree.
#include "core/lab/measure/god_object.h"
#include "core/lab/objects/generate.h"
#include "tests/core/recorded_scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a god-object stops at a wall, slides along it, and in a corner stays in it") {
  const ScenePtr corner = recorded_scene("inner_corner").scene;
  GodObject god(corner->mesh(), 0.005, {0.020, 0.0, 0.020});
  CHECK(glm::distance(god.follow({0.020, 0.0, 0.004}), Vec3(0.020, 0.0, 0.005)) < 1e-12);
  CHECK(glm::distance(god.follow({0.010, 0.003, 0.003}), Vec3(0.010, 0.003, 0.005)) < 1e-12);
  CHECK(glm::distance(god.follow({0.002, 0.003, 0.003}), Vec3(0.005, 0.003, 0.005)) < 1e-12);
  CHECK(glm::distance(god.follow({0.002, 0.004, 0.008}), Vec3(0.005, 0.004, 0.008)) < 1e-12);
  CHECK(glm::distance(god.follow({0.007, 0.004, 0.008}), Vec3(0.007, 0.004, 0.008)) < 1e-12);
}

TEST_CASE("a god-object does not come through a closed cube, whichever way the finger goes") {
  const auto cube = scene_of(*generate_mesh("cube"));
  const double half = 0.5 * cube->mesh().bounds().size().x;
  Random random{71};
  GodObject god(cube->mesh(), 0.0, {0.0, 0.0, 0.060});
  Vec3 finger(0.0, 0.0, 0.060);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    finger = glm::clamp(finger + 2e-3 * random.direction(), Vec3(-0.045), Vec3(0.045));
    const Vec3 at = god.follow(finger);
    inside += std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < half - 1e-9;
  }
  CHECK(inside == 0);
}

TEST_CASE(
    "in the inner corner the force of all places is the god-object's, tick by tick, and the deepest place's is not") {
  const RecordedScene recorded = recorded_scene("inner_corner");
  for (const double radius : {0.005, 0.020}) {
    CAPTURE(radius);
    for (const ForceContacts contacts : {ForceContacts::all, ForceContacts::deepest}) {
      Preset preset = sphere_preset(radius, Method::robust);
      preset.force.contacts = contacts;
      preset.force.limit_n = 100.0;
      Stepper stepper(recorded.scene);
      TickState state;
      GodObject god(recorded.scene->mesh(), radius, {0.020, 0.0, 0.020});
      int differ = 0;
      for (std::size_t i = 0; i < recorded.poses.size(); ++i) {
        const TickInput& input = recorded.poses[i];
        const TickOutput out = stepper.step(preset, input, state);
        const Vec3 force = 800.0 * (god.follow(input.finger.position) - input.finger.position);
        differ += i > 0 && glm::distance(force, out.decided_force_n) > 1e-5;
      }
      if (contacts == ForceContacts::all)
        CHECK(differ == 0);
      else
        CHECK(differ > 1900);
    }
  }
}
