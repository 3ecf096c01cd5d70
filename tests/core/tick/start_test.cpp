// A first search, that of a first tick or of one after a leap, takes a tick's work at most and goes on in the next
// ones: no tick is late, and a finger that is held comes to the contact that a search in one go finds.
#include "core/base/tolerances.h"
#include "core/lab/objects/generate.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"
#include "tests/core/spiky_ground.h"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Evaluations that no tick may take: a first search's work is 440 us, an evaluation 0.7 (search_work.h), and a part
/// that it has begun with is done to its end.
constexpr int kMostOfFirst = 1600, kMostAfter = 600;
constexpr int kMostTicks = 400;

/// As large as the random bodies, of 20,480 triangles, with noise on every vertex.
PolygonMesh rough_ball() {
  Random random(19);
  PolygonMesh mesh = make_icosphere(1.0, 5);
  for (Vec3& p : mesh.positions) p *= 0.036 * (1.0 + random.in(-1e-3, 1e-3) + 0.06 * std::sin(5.0 * p.x + 3.0 * p.y));
  return mesh;
}

struct Place {
  FingerPose pose;
  Preset preset;
};

/// Fingers that are not round, deep in a body, over the middles of triangles anywhere.
std::vector<Place> places_in(const ContactMesh& mesh, int count, double least_m, double most_m, Random& random) {
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t t = random.below(mesh.triangle_count());
    Place place;
    place.preset = sphere_preset(0.020, Method::robust);
    place.preset.finger = finger_of(i % 2 == 0 ? FingerShape::ellipsoid : FingerShape::capsule);
    if (i % 4 == 0) place.preset.finger.semi_axes_m = {0.020, 0.010, 0.008};
    const Vec3 normal = unit(mesh.normal(t, 0) + mesh.normal(t, 1) + mesh.normal(t, 2));
    const Vec3 middle = mesh.origin() + (mesh.position(t, 0) + mesh.position(t, 1) + mesh.position(t, 2)) / 3.0;
    place.pose = resting_on(place.preset.finger, middle, normal, random.in(least_m, most_m), random);
    places.push_back(place);
  }
  return places;
}

double rank_of(const Finger& finger, const FingerPose& pose, const TickOutput& out) {
  const double height = glm::dot(pose.position - out.contact, out.normal);
  return finger.reach_m() - (height < 0.0 ? height : out.penetration_m);
}

struct Held {
  int poses = 0, broke_off = 0, shallower = 0, unlike = 0, endless = 0;
  int most_of_first = 0, most_after = 0, most_at_once = 0, longest = 0;
};

/// Every place held until no tick says `searching`, against the same search in one tick. `leap_from`: where the finger
/// is put there from; null: its first tick is there.
void hold(const ScenePtr& scene, const std::vector<Place>& places, const Vec3* leap_from, Held& held) {
  for (const Place& place : places) {
    const TickOutput whole = solve_once(scene, place.preset, place.pose);
    Stepper stepper(scene);
    TickState state;
    if (leap_from) stepper.step(place.preset, at_position(-1e-3, *leap_from), state);
    TickOutput out = stepper.step(place.preset, {0.0, place.pose}, state);
    held.broke_off += state.start == Start::searching;
    held.most_of_first = std::max(held.most_of_first, out.iterations);
    held.most_at_once = std::max(held.most_at_once, whole.iterations);
    int ticks = 1, starting = state.start == Start::searching;
    for (; out.searching && ticks < kMostTicks; ++ticks) {
      out = stepper.step(place.preset, {1e-3 * ticks, place.pose}, state);
      held.most_after = std::max(held.most_after, out.iterations);
      starting += state.start == Start::searching;
    }
    ++held.poses;
    held.longest = std::max(held.longest, starting);
    held.endless += ticks == kMostTicks;
    held.unlike += is_converged(out.status) != is_converged(whole.status);
    const Finger& finger = place.preset.finger;
    // With force from all places the one that is shown may be shallower by a tremor.
    const double held_by = (kTremor + 0.25) * place.preset.solver.switch_hysteresis_m;
    held.shallower += is_converged(out.status) && is_converged(whole.status) &&
                      rank_of(finger, place.pose, out) > rank_of(finger, place.pose, whole) + held_by;
  }
}

void say(const Held& held) {
  MESSAGE(held.poses << " fingers, " << held.broke_off << " searches went on, for " << held.longest
                     << " ticks at most; shallower " << held.shallower << ", otherwise unlike " << held.unlike
                     << ", endless " << held.endless << "; planes at once " << held.most_at_once << ", first tick "
                     << held.most_of_first << ", after it " << held.most_after);
}

}  // namespace

TEST_CASE("a finger that is held where its first search broke off comes to the contact of a whole one") {
  Random random(23);
  const ScenePtr scene = scene_of(rough_ball());
  const Vec3 above = scene->mesh().origin() + Vec3(0.0, 0.0, 0.080);
  for (const bool leaps : {false, true}) {
    CAPTURE(leaps);
    Held held;
    hold(scene, places_in(scene->mesh(), std::max(40, rounds(200)), 0.005, 0.020, random), leaps ? &above : nullptr,
         held);
    say(held);
    CHECK(held.broke_off * 10 > held.poses);
    CHECK(held.shallower == 0);
    CHECK(held.unlike == 0);
    CHECK(held.endless == 0);
    CHECK(held.most_of_first < kMostOfFirst);
    CHECK(held.most_after < kMostAfter);
  }
}

TEST_CASE("on spikes, too, a first search goes on to its end, and no tick of it is late") {
  Random random(29);
  Held held;
  for (std::uint64_t seed = 3; seed < 6; ++seed) {
    const ScenePtr scene = Spikes(3e-3, seed).scene();
    hold(scene, places_in(scene->mesh(), rounds(40), 0.001, 0.010, random), nullptr, held);
  }
  say(held);
  CHECK(held.broke_off * 2 > held.poses);
  CHECK(held.shallower * 20 <= held.poses);  // the contact that it goes on from may be lost beside a fold
  CHECK(held.unlike * 50 <= held.poses);
  CHECK(held.endless == 0);
  CHECK(held.most_of_first < kMostOfFirst);
  CHECK(held.most_after < 2 * kMostAfter);
  CHECK(held.most_at_once > 2 * held.most_of_first);
}

TEST_CASE("a first search that goes on is the same bits from its state alone, and ends when the finger has moved on") {
  const ScenePtr scene = Spikes(3e-3, 3).scene();
  Random random(31);
  int went_on = 0, different = 0, still = 0;
  for (const Place& place : places_in(scene->mesh(), 20, 0.001, 0.010, random)) {
    Stepper stepper(scene);
    TickState state;
    int searching = 0;
    for (int i = 0; i < 100; ++i) {
      TickInput input{1e-3 * i, place.pose};
      input.finger.position.x += 2e-4 * i;
      TickState other = state;
      const TickOutput kept = stepper.step(place.preset, input, state);
      const TickOutput fresh = Stepper(scene).step(place.preset, input, other);
      different += kept.contact != fresh.contact || kept.force_n != fresh.force_n ||
                   kept.iterations != fresh.iterations || kept.searching != fresh.searching ||
                   state.start != other.start || state.clearance.next.node != other.clearance.next.node;
      searching += state.start == Start::searching;
    }
    went_on += searching > 0;
    still += state.start == Start::searching;
  }
  CHECK(went_on > 5);
  CHECK(different == 0);
  CHECK(still == 0);
}

TEST_CASE("what is found deeper while a first search goes on is blended in, as everything else") {
  Random random(37);
  const ScenePtr scene = scene_of(rough_ball());
  int switched = 0;
  double most = 0.0;
  for (const Place& place : places_in(scene->mesh(), rounds(200), 0.005, 0.020, random)) {
    Stepper stepper(scene);
    TickState state;
    Vec3 last(0.0);
    for (int i = 0; i < 30; ++i) {
      const TickOutput out = stepper.step(place.preset, {1e-3 * i, place.pose}, state);
      if (i > 0) {
        switched += out.event == TickEvent::switched;
        most = std::max(most, glm::length(out.force_n - last));
      }
      last = out.force_n;
    }
  }
  MESSAGE(switched << " switches, the force of a held finger changes by " << most << " N in a tick at most");
  CHECK(switched > 0);
  CHECK(most < 0.0201);  // 20 N/s
}
