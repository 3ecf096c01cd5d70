// A search that takes more than a tick's work goes on in the next ticks, and ends with the same knowledge.
#include "core/contact/decide/decide.h"
#include "core/contact/prove/late_hierarchy.h"
#include "core/contact/search_work.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Rounds, but no fewer than that: a search of several ticks must come up.
int at_least(int least, int full) { return std::max(least, rounds(full)); }

ContactQuery query_at(const Vec3& centre) {
  ContactQuery query;
  query.centre = centre;
  query.nearest_m = 0.030;
  query.inside_m = 0.010;
  query.margin_m = 0.002;
  return query;
}

/// The triangles that a visit comes to, while its bounds shrink by that ratio at each.
std::vector<std::uint32_t> visited_in_parts(const LateHierarchy& hierarchy, ContactQuery query, double shrinks,
                                            int work, int& parts) {
  std::vector<std::uint32_t> triangles;
  const auto visit = [&](std::uint32_t t, ContactQuery& q) {
    triangles.push_back(t);
    q.nearest_m *= shrinks;
    return true;
  };
  VisitPlace place;
  for (parts = 1;; ++parts) {
    query.work = 0;
    query.most_work = work;
    if (hierarchy.visit_from(place, query, visit)) return triangles;
  }
}

/// A ball with knobs all over, each a few triangles wide.
PolygonMesh knobby_ball(int level) {
  PolygonMesh body = make_icosphere(0.040, level);
  for (Vec3& p : body.positions)
    p *= 1.0 + 0.02 * std::sin(900.0 * p.x) * std::sin(700.0 * p.y) * std::sin(800.0 * p.z);
  body.normals.clear();
  body.corner_normal.clear();
  return body;
}

/// The finger goes round the ball in a spiral, its centre so far from the ball's.
TickInput round_the_ball(int tick, double step_m, double out_m) {
  const double turn = step_m / out_m * tick, lift = 0.9 * std::sin(0.13 * turn);
  const Vec3 at = out_m * Vec3(std::cos(lift) * std::cos(turn), std::cos(lift) * std::sin(turn), std::sin(lift));
  return at_position(1e-3 * tick, at);
}

struct Spread {
  int ticks = 0, searching = 0, longest = 0, behind = 0, behind_in_time = 0, evaluations = 0;
  double late_m = 0.0;
};

Spread go_round(const ScenePtr& scene, const Preset& preset, int ticks, double step_m, double out_m) {
  Stepper tracking(scene), searching(scene);
  TickState state;
  Spread spread;
  int run = 0;
  for (int i = 0; i < ticks; ++i) {
    const TickInput input = round_the_ball(i, step_m, out_m);
    const TickOutput out = tracking.step(preset, input, state);
    ++spread.ticks;
    spread.searching += out.searching;
    run = out.searching ? run + 1 : 0;
    spread.longest = std::max(spread.longest, run);
    spread.late_m = std::max(spread.late_m, double{state.late_m});
    if (i > 0 && out.event == TickEvent::none) spread.evaluations = std::max(spread.evaluations, out.iterations);
    TickState fresh;
    const TickOutput cold = searching.step(preset, input, fresh);
    const double room = preset.solver.switch_hysteresis_m + preset.solver.tolerance_m;
    if (state.unentered || !(cold.penetration_m - out.penetration_m > room)) continue;
    ++(out.searching ? spread.behind : spread.behind_in_time);
  }
  return spread;
}

Preset deepest_preset(const Finger& finger) {
  Preset preset = sphere_preset(finger.radius_m, Method::robust);
  preset.finger = finger;
  preset.force.contacts = ForceContacts::deepest;
  return preset;
}

}  // namespace

TEST_CASE("a visit that breaks off and goes on comes to the same triangles in the same order, however often") {
  Random random(21);
  const auto scene = scene_of(knobby_ball(4));
  const TriangleClusters clusters = TriangleClusters::build(scene->mesh());
  const LateHierarchy whole(scene->mesh(), nullptr), parted(scene->mesh(), &clusters);
  int broken = 0, different = 0, more = 0, found = 0;
  const int queries = at_least(20, 60);
  for (int i = 0; i < queries; ++i) {
    const ContactQuery query = query_at(random.in(0.01, 0.06) * random.direction());
    const int work = 60 + static_cast<int>(random.below(4000));
    for (const LateHierarchy* hierarchy : {&whole, &parted}) {
      const auto visited = [&](double shrinks, int most) {
        int parts = 0;
        const auto triangles = visited_in_parts(*hierarchy, query, shrinks, most, parts);
        broken += parts > 2;
        return triangles;
      };
      constexpr int kAll = std::numeric_limits<int>::max();
      found += !visited(1.0, kAll).empty();
      different += visited(1.0, work) != visited(1.0, kAll);
      // What bounds that have shrunk rule out is asked anew where it goes on.
      const auto all = visited(0.9999, kAll), some = visited(0.9999, work);
      more += !std::includes(all.begin(), all.end(), some.begin(), some.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto at = [&](std::uint32_t t) { return std::find(all.begin(), all.end(), t); };
        return at(a) < at(b);
      });
    }
  }
  CHECK(different == 0);
  CHECK(more == 0);
  CHECK(found >= queries / 2);
  CHECK(broken >= queries / 2);
}

TEST_CASE("a search over several ticks says so, ends, and a tick that does not search has the deepest place") {
  const ScenePtr scene = scene_of(knobby_ball(6));
  Finger ball{.shape = FingerShape::sphere, .radius_m = 0.020};
  Finger ellipsoid{.shape = FingerShape::ellipsoid, .semi_axes_m = {0.020, 0.010, 0.008}};
  for (const Finger& finger : {ball, ellipsoid}) {
    CAPTURE(static_cast<int>(finger.shape));
    const double out = 0.040 + (finger.shape == FingerShape::sphere ? 0.0195 : 0.0085);
    const Spread spread = go_round(scene, deepest_preset(finger), at_least(300, 1500), 5e-4, out);
    MESSAGE(spread.searching << " of " << spread.ticks << " ticks searching, at most " << spread.longest
                             << " in a row; behind in " << spread.behind << " of them, else in "
                             << spread.behind_in_time << "; " << spread.evaluations << " evaluations at most");
    CHECK(spread.searching > 0);
    CHECK(spread.behind_in_time <= spread.ticks / 500);
    CHECK(spread.behind <= spread.searching / 4);
  }
}

TEST_CASE("a finger at the middle of a ball, where every triangle holds a contact, is searched for in parts") {
  const ScenePtr scene = scene_of(make_icosphere(0.040, 5));
  const Preset preset = deepest_preset({.shape = FingerShape::sphere, .radius_m = 0.045});
  Stepper stepper(scene);
  TickState state;
  Random random(5);
  int most = 0;
  for (int i = 0; i < 200; ++i) {
    const TickOutput out = stepper.step(preset, at_position(1e-3 * i, 1e-5 * random.direction()), state);
    if (i > 0 && out.event == TickEvent::none) most = std::max(most, out.iterations);
  }
  constexpr SearchWork kWork = SearchWork::of_round();
  const int allowed = static_cast<int>(kWork.late * kTickWork) / kWork.evaluation + 64;
  CHECK(most <= allowed);
}

TEST_CASE("where rough ground offers no contact it is looked for in parts, and found again") {
  Random random(3);
  const ScenePtr scene = scene_of(height_field(0.04, 140, [&](double, double) { return random.in(-2e-3, 2e-3); }));
  const Preset preset = deepest_preset({.shape = FingerShape::sphere, .radius_m = 0.002});
  Stepper tracking(scene), searching(scene);
  TickState state;
  int facing = 0, parts = 0, most = 0, missed = 0;
  bool last_too = false;
  const int ticks = at_least(600, 2000);
  for (int i = 0; i < ticks; ++i) {
    const double t = 1e-3 * i;
    const TickInput input = at_position(t, {0.025 * std::sin(3.1 * t), 0.025 * std::cos(2.3 * t), -0.5e-3});
    const TickOutput out = tracking.step(preset, input, state);
    const bool faces = out.status == TickStatus::facing;
    if (faces && last_too) {
      ++facing;
      parts += out.searching;
      most = std::max(most, out.iterations);
      TickState fresh;
      missed += searching.step(preset, input, fresh).status != TickStatus::facing;
    }
    last_too = faces;
  }
  MESSAGE(facing << " ticks face after one that did, " << parts << " of them look on at the next, " << most
                 << " evaluations at most; " << missed << " of them have a contact that is not found yet");
  CHECK(facing > ticks / 20);
  CHECK(parts > 0);
  CHECK(most < 400);
  CHECK(missed * 10 <= facing);
}

TEST_CASE("an ellipsoid or a capsule that loses its contact on spikes looks for another in parts") {
  Random random(3);
  const auto noise = [&](double, double) { return 3e-3 * (random.in(-1.0, 1.0) + random.in(-1.0, 1.0)); };
  const ScenePtr spikes = scene_of(height_field(0.040, 60, noise));
  int lost_by_any = 0;
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    Preset preset = sphere_preset(0.020, Method::robust);
    preset.finger = finger_of(shape);
    Stepper stepper(spikes);
    TickState state;
    int most = 0, first = 0, facing = 0, lost = 0;
    const int ticks = at_least(1000, 3000);
    for (int i = 0; i < ticks; ++i) {
      const double t = 1e-3 * i;
      const Vec3 at(0.025 * std::sin(19.0 * t), 0.025 * std::cos(14.0 * t), 0.002 + 0.003 * std::sin(22.0 * t));
      const TickOutput out = stepper.step(preset, at_position(t, at), state);
      (i > 0 ? most : first) = std::max(i > 0 ? most : first, static_cast<int>(out.iterations));
      facing += out.status == TickStatus::facing;
      lost += out.event == TickEvent::reseed;
    }
    MESSAGE("at most " << most << " planes in a tick, " << first << " in the first; " << lost << " lost, " << facing
                       << " facing of " << ticks);
    lost_by_any += lost;
    CHECK(most < 2000);
    CHECK(first < 4500);
    CHECK(facing * 20 < ticks);
  }
  CHECK(lost_by_any > 0);
}

TEST_CASE("an ellipsoid or a capsule that is put elsewhere and stays there comes to what a first tick finds") {
  Random random(5);
  const auto noise = [&](double, double) { return 1.2e-3 * (random.in(-1.0, 1.0) + random.in(-1.0, 1.0)); };
  const ScenePtr scenes[] = {scene_of(height_field(0.040, 120, noise)), scene_of(make_icosphere(0.040, 5))};
  int places = 0, shallower = 0, left_free = 0;
  for (const ScenePtr& scene : scenes)
    for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
      Preset preset = sphere_preset(0.020, Method::robust);
      preset.finger = finger_of(shape);
      preset.finger.semi_axes_m = {0.020, 0.010, 0.008};
      const ContactMesh& mesh = scene->mesh();
      for (int i = 0; i < at_least(5, 60); ++i) {
        const std::uint32_t t = random.below(mesh.triangle_count());
        const Vec3 over = mesh.origin() + mesh.position(t, 0) + random.in(-0.004, 0.008) * mesh.normal(t, 0);
        const Quat turn = random.orientation();
        TickInput input{0.0, {over + 0.03 * mesh.normal(t, 0), turn}};
        Stepper stepper(scene), from_nothing(scene);
        TickState state, fresh;
        stepper.step(preset, input, state);
        TickOutput out;
        for (int tick = 1; tick <= 40; ++tick) {
          input = {1e-3 * tick, {over, turn}};
          out = stepper.step(preset, input, state);
        }
        const TickOutput cold = from_nothing.step(preset, input, fresh);
        ++places;
        const double held = kTremor * preset.solver.switch_hysteresis_m + 2.0 * kHeightGuess * preset.finger.reach_m();
        const bool touches = cold.penetration_m > 0.0;
        shallower += touches && !out.searching && cold.penetration_m - out.penetration_m > held;
        left_free += touches && out.status == TickStatus::free;
      }
    }
  MESSAGE(shallower << " of " << places << " end at a shallower place, " << left_free << " touch nothing");
  CHECK(shallower == 0);
  CHECK(left_free == 0);
}

TEST_CASE("the state alone carries a search that is under way from one tick to the next") {
  const ScenePtr scene = scene_of(knobby_ball(6));
  const Preset preset = deepest_preset({.shape = FingerShape::sphere, .radius_m = 0.020});
  Stepper one(scene);
  TickState state;
  int compared = 0, different = 0;
  for (int i = 0; i < at_least(300, 1500); ++i) {
    const TickInput input = round_the_ball(i, 5e-4, 0.0595);
    if (state.clearance.under_way && ++compared <= 40) {
      Stepper another(scene);
      TickState copy = state, mine = state;
      const TickOutput a = another.step(preset, input, copy), b = one.step(preset, input, mine);
      different += a.penetration_m != b.penetration_m || a.iterations != b.iterations || a.searching != b.searching ||
                   copy.clearance.free_m != mine.clearance.free_m;
    }
    one.step(preset, input, state);
  }
  CHECK(compared > 0);
  CHECK(different == 0);
}

TEST_CASE("what a late search finds was entered: the finger's way since then counts") {
  const FingerStep in_time{1e-4, 2e-5, 0.0}, late{1e-4, 2e-5, 5e-4};
  CHECK_FALSE(was_entered(in_time, 0.0010, 0.0));
  CHECK(was_entered(late, 0.0010, 0.0));
  CHECK_FALSE(was_entered(late, 0.0020, 0.0));
  CHECK_FALSE(was_entered({1e-4, 2e-5, 1.0}, 0.0030, 0.0));
}

TEST_CASE("a place of another tree begins a visit anew") {
  const auto scene = scene_of(make_icosphere(0.040, 3));
  const LateHierarchy hierarchy(scene->mesh(), nullptr);
  for (const std::uint32_t node : {std::uint32_t{7}, std::uint32_t{4000000000u}}) {
    VisitPlace place{node, node};
    ContactQuery query = query_at({0.05, 0.0, 0.0});
    int seen = 0;
    const auto visit = [&](std::uint32_t, ContactQuery&) { return ++seen, true; };
    CHECK(hierarchy.visit_from(place, query, visit));
  }
}
