// A finger that is not round and touches nothing looks only for places that it may soon touch: it misses none of them,
// and its ticks cost little however far off the surface it is.
#include "core/base/tolerances.h"
#include "tests/core/fingers.h"
#include "tests/core/random_bodies.h"
#include "tests/core/scenes.h"

#include <algorithm>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

Preset preset_of(const Finger& finger, ForceContacts contacts) {
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.finger = finger;
  preset.force.contacts = contacts;
  return preset;
}

/// Deeper, a search from nothing finds places that a finger of this size has come to behind, not from outside.
constexpr double kDeep = 5e-3;

struct Flight {
  int free = 0, touching = 0, behind = 0, unconverged = 0, searching = 0;
  long planes_free = 0;
};

/// Round the body, down onto it and off again 15 mm, at some 0.15 m/s.
void fly(const ScenePtr& scene, const Preset& preset, Random& random, int ticks, Flight& flight) {
  Stepper stepper(scene), from_nothing(scene);
  TickState state;
  const Box& box = scene->mesh().bounds();
  const Vec3 middle = scene->mesh().origin() + box.centre();
  const double radius = 0.5 * glm::length(box.size()) / std::sqrt(3.0) + 0.5 * preset.finger.reach_m();
  Vec3 at = random.direction();
  const Vec3 axis = random.direction();
  const Quat orientation = random.orientation();
  for (int i = 0; i < ticks; ++i) {
    at = unit(at + 5e-4 * glm::cross(axis, at));
    const double off = 0.005 + 0.012 * std::sin(2.0 * std::numbers::pi * i / 600.0);
    const TickInput input{1e-3 * i, {middle + (radius + off) * at, orientation}};
    const TickOutput out = stepper.step(preset, input, state);
    TickState fresh;
    const TickOutput cold = from_nothing.step(preset, input, fresh);
    flight.unconverged += out.status == TickStatus::unconverged;
    if (!(std::max(cold.penetration_m, out.penetration_m) > 0.0)) {
      ++flight.free;
      flight.planes_free += i > 0 ? out.iterations : 0;
      flight.searching += out.searching;
      continue;
    }
    if (cold.penetration_m > kDeep) continue;
    ++flight.touching;
    const double held = kTremor * preset.solver.switch_hysteresis_m + 2.0 * kHeightGuess * preset.finger.reach_m();
    flight.behind += !out.searching && std::max(0.0, cold.penetration_m) - std::max(0.0, out.penetration_m) > held;
  }
}

}  // namespace

TEST_CASE("a free ellipsoid or capsule that comes down touches at the deepest place, and costs little until then") {
  Random random(63);
  std::vector<ScenePtr> bodies{spot_scene(45.0), scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3})),
                               scene_of(*generate_mesh("cylinder"))};
  for (int i = 0; i < 3; ++i) bodies.push_back(scene_of(random_blob(random)));
  Finger ellipsoid, capsule;
  ellipsoid.shape = FingerShape::ellipsoid;
  ellipsoid.semi_axes_m = {0.020, 0.010, 0.008};
  capsule.shape = FingerShape::capsule;
  capsule.radius_m = 0.008;
  long free = 0, planes = 0;
  for (const Finger& finger : {ellipsoid, capsule})
    for (const ForceContacts contacts : {ForceContacts::all, ForceContacts::deepest}) {
      Flight flight;
      for (const ScenePtr& body : bodies) fly(body, preset_of(finger, contacts), random, rounds(3000), flight);
      MESSAGE(flight.touching << " ticks touch, " << flight.behind << " behind, " << flight.unconverged
                              << " unconverged; " << flight.free << " free, " << flight.searching << " of them search, "
                              << flight.planes_free << " planes");
      CHECK(flight.touching > rounds(2000));
      CHECK(flight.behind == 0);
      CHECK(flight.unconverged == 0);
      CHECK(flight.free > rounds(5000));
      free += flight.free;
      planes += flight.planes_free;
    }
  CHECK(planes < 3 * free);
}
