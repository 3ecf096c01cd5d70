// Searching for deeper places only when the clearance is used up finds the same as searching at every tick.
#include "core/contact/search/rivals.h"
#include "core/base/tolerances.h"
#include "core/contact/decide/decide.h"
#include "core/lab/objects/generate.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A finger that wanders over two bumps, too large for the valley between them.
std::vector<TickInput> wander(int ticks, double speed_m) {
  std::vector<TickInput> poses;
  for (int i = 0; i < ticks; ++i) {
    const double s = speed_m * i;
    poses.push_back(
        {1e-3 * i,
         {Vec3(0.006 * std::sin(s / 0.004), 0.004 * std::sin(s / 0.0093), 0.0105), Quat(1.0, 0.0, 0.0, 0.0)}});
  }
  return poses;
}

ScenePtr bumps() {
  return scene_of(height_field(0.020, 60, [](double x, double y) {
    return 0.003 * std::exp(-((x - 0.005) * (x - 0.005) + y * y) / 1.2e-5) +
           0.003 * std::exp(-((x + 0.005) * (x + 0.005) + y * y) / 1.2e-5);
  }));
}

/// Smooth ground of random hills and hollows, 60 mm wide, that bend by a radius of about 3 to 30 mm.
ScenePtr random_ground(Random& random, int cells) {
  struct Wave {
    double x, y, phase, height;
  };
  std::array<Wave, 6> waves;
  for (Wave& wave : waves) {
    const double length = random.in(0.008, 0.050), turn = random.in(0.0, 6.28);
    wave = {6.28 / length * std::cos(turn), 6.28 / length * std::sin(turn), random.in(0.0, 6.28),
            length * length / 40.0 / random.in(0.003, 0.030)};
  }
  return scene_of(height_field(0.060, cells, [&](double x, double y) {
    double z = 0.0;
    for (const Wave& w : waves) z += w.height * std::sin(w.x * x + w.y * y + w.phase) / 2.5;
    return z;
  }));
}

/// A finger that is led over the ground at 1 mm of depth, by the last contact's normal, or at rest, or at a run.
struct Wanderer {
  Vec3 position;
  Vec3 heading;
  double step_m = 0.0;

  void go(const TickOutput& last, Random& random) {
    const Vec3 n = last.normal;
    if (random.below(100) == 0) heading = random.direction();
    if (random.below(300) == 0) step_m = random.below(4) == 0 ? 0.0 : 1e-3 * std::pow(10.0, random.in(-2.5, 0.0));
    if (std::abs(position.x) > 0.022) heading.x = -position.x;
    if (std::abs(position.y) > 0.022) heading.y = -position.y;
    const Vec3 along = heading - glm::dot(heading, n) * n;
    position += step_m * along / std::max(1e-9, std::sqrt(glm::dot(along, along)));
    position += 0.2 * (last.penetration_m - 1e-3) * n;
  }
};

}  // namespace

namespace {

struct Found {
  int ticks = 0, switches = 0, shallower = 0, unentered = 0, searching = 0, late = 0;
};

/// Steps over 24 grounds; at every tick the contact is compared with what a search from nothing finds.
Found wander_over_random_grounds(std::uint64_t seed, int grounds) {
  Random random(seed);
  Found found;
  for (int ground = 0; ground < grounds; ++ground) {
    const ScenePtr scene = random_ground(random, 12 << random.below(4));
    const double radius = std::array{0.0, 0.002, 0.005, 0.020}[static_cast<std::size_t>(ground) % 4];
    Preset preset = sphere_preset(radius, Method::robust);
    preset.force.contacts = ForceContacts::deepest;  // with all places the shown one waits for more than a tremor
    if (radius == 0.0) preset.finger.shape = FingerShape::point;
    Stepper tracking(scene), searching(scene);
    TickState state;
    Wanderer finger{{0.0, 0.0, 0.030 + radius}, {1.0, 0.0, 0.0}};
    for (int i = 0; i < 4000; ++i) {
      const TickInput input = at_position(1e-3 * i, finger.position);
      const Vec3 before = state.has_previous ? state.last_position : finger.position;
      const TickOutput tracked = tracking.step(preset, input, state);
      finger.go(tracked, random);
      found.switches += tracked.event == TickEvent::switched;
      ++found.ticks;
      found.searching += tracked.searching;
      // One that was come upon from behind does not push, and no other place is compared with it (decide.h).
      if (state.unentered) continue;
      TickState fresh;
      const TickOutput cold = searching.step(preset, input, fresh);
      const double behind = cold.penetration_m - tracked.penetration_m - preset.solver.switch_hysteresis_m;
      if (behind <= 2.0 * kHeightGuess * std::max(radius, 1e-3) + preset.solver.tolerance_m) continue;
      // At the ground's rim the same place may be seen from before it and from behind.
      if (glm::distance(cold.contact, tracked.contact) < kMergedPlaces * preset.solver.tolerance_m) continue;
      if (tracked.searching) {
        ++found.late;
        continue;
      }
      const FingerStep step{glm::distance(input.finger.position, before), preset.solver.switch_hysteresis_m};
      const bool counts = was_entered(step, cold.penetration_m, tracked.penetration_m);
      found.shallower += counts;
      found.unentered += !counts;
    }
  }
  return found;
}

}  // namespace

TEST_CASE("on random ground the tracked contact is the deepest place, as a search from nothing finds it") {
  // Four of twelve seeds tried, 1 to 12; on the others it is 0, too. Seed 6 had 9 and seed 7 had 1 while a face was
  // given up whose bisection took more tests than it may; seed 8 had 2 when heights were taken to change along the
  // normals. At a fold a place may come up that is deeper by more than can have been entered: 7 on seed 10.
  const int grounds = std::max(4, rounds(24));
  for (const std::uint64_t seed : {6, 7, 8, 10}) {
    if (testing::kSanitized && seed != 6) continue;
    const Found found = wander_over_random_grounds(seed, grounds);
    MESSAGE("seed " << seed << ": " << found.switches << " switches in " << found.ticks << " ticks, " << found.shallower
                    << " shallower than a search from nothing, " << found.unentered << " than what was never entered; "
                    << found.searching << " searching, " << found.late << " of them shallower");
    CHECK(found.switches > grounds);
    CHECK(found.shallower == 0);
    CHECK(found.unentered <= 8);
    CHECK(found.searching * 20 <= found.ticks);
    CHECK(found.late <= 60);
  }
}

TEST_CASE("on a ball, which nowhere folds, a search looks ever further ahead") {
  const ScenePtr scene = scene_of(make_icosphere(0.040, 3));
  const Preset preset = sphere_preset(0.020, Method::robust);
  Stepper stepper(scene);
  TickState state;
  int asked = 0;
  Vec3 centre(0.0);
  for (int i = 0; i < 4000; ++i) {
    const double turn = 1e-4 / 0.059 * i;
    stepper.step(preset, at_position(1e-3 * i, 0.059 * Vec3(std::cos(turn), std::sin(turn), 0.1)), state);
    asked += state.clearance.centre != centre;
    centre = state.clearance.centre;
    CHECK(std::uint32_t{state.clearance.watched_count} == 0);
  }
  CHECK(asked < 80);
}

TEST_CASE("a search that waits for its margins switches when one at every tick would, and to the same place") {
  const ScenePtr scene = bumps();
  const Preset preset = sphere_preset(0.010, Method::robust);
  Stepper seldom(scene), always(scene);
  TickState a, b;
  int switches = 0, differ = 0;
  for (const TickInput& input : wander(rounds(20000), 2e-5)) {
    const TickOutput x = seldom.step(preset, input, a);
    b.clearance = Clearance{};
    const TickOutput y = always.step(preset, input, b);
    switches += x.event == TickEvent::switched;
    differ += x.triangle != y.triangle || std::abs(x.penetration_m - y.penetration_m) > 2.0 * preset.solver.tolerance_m;
  }
  CHECK(switches > 0);
  CHECK(differ == 0);
}

TEST_CASE("most ticks ask nothing, and most that ask look at single triangles") {
  const ScenePtr scene = bumps();
  const Preset preset = sphere_preset(0.010, Method::robust);
  Stepper stepper(scene);
  TickState state;
  int whole = 0, asked = 0, ticks = 0;
  Vec3 centre(0.0);
  double rest = -1.0;
  for (const TickInput& input : wander(rounds(20000), 2e-5)) {
    stepper.step(preset, input, state);
    ++ticks;
    asked += state.clearance.centre != centre;
    whole += state.clearance.margin_m > rest;  // it only shrinks between searches
    rest = state.clearance.margin_m;
    centre = state.clearance.centre;
  }
  CHECK(whole > 0);
  CHECK(whole < ticks / 4);
  CHECK(asked < ticks / 2);
}

TEST_CASE("a finger that trembles in place asks a few times in all, and gets what asking at every tick gets") {
  const ScenePtr scene = scene_of(make_torus(0.040, 0.015, 48, 24));
  const Preset preset = sphere_preset(0.020, Method::robust);
  constexpr double kReach = 1e-5;  // m
  Random random(31);
  for (const bool tremor : {false, true}) {
    CAPTURE(tremor);
    for (int place = 0; place < 5; ++place) {
      // Pressed about 1 mm deep from above, somewhere on the torus.
      const double ring = random.in(0.0, 6.28), across = random.in(-0.010, 0.010);
      const Vec3 rest((0.040 + across) * std::cos(ring), (0.040 + across) * std::sin(ring),
                      std::sqrt(0.034 * 0.034 - across * across));
      Stepper seldom(scene), always(scene);
      TickState a, b;
      int asked = 0, differ = 0;
      for (int i = 0; i < rounds(10000); ++i) {
        // A new position within 10 um at each tick, or a Lissajous figure at 9 and 11 Hz, like a hand's tremor.
        const Vec3 off = tremor ? kReach * Vec3(std::sin(0.0565 * i), std::sin(0.0691 * i), 0.3 * std::sin(0.0565 * i))
                                : random.in(0.0, kReach) * random.direction();
        const Vec3 centre = a.clearance.centre;
        const TickOutput x = seldom.step(preset, at_position(1e-3 * i, rest + off), a);
        asked += a.clearance.centre != centre;
        b.clearance = Clearance{};
        const TickOutput y = always.step(preset, at_position(1e-3 * i, rest + off), b);
        differ +=
            x.triangle != y.triangle || x.u != y.u || x.v != y.v || x.contact != y.contact || x.force_n != y.force_n;
      }
      CHECK(asked <= 4);
      CHECK(differ == 0);
    }
  }
}

TEST_CASE("a finger that runs along a rim asks seldom: the next edge and the vertex before it lead the contact back") {
  const auto cylinder = generate_mesh("cylinder", {});
  REQUIRE(cylinder);
  const ScenePtr scene = scene_of(*cylinder);
  const Preset preset = sphere_preset(0.020, Method::robust);
  Stepper stepper(scene);
  TickState state;
  Vec3 centre(0.0);
  int asked = 0, on_the_rim = 0;
  for (int i = 0; i < 4000; ++i) {
    // 1 mm deep on the rim of 40 mm about the x axis, from between the side and the end.
    const double turn = 0.1 * i / 40.0, out = 0.040 + 0.019 * std::sqrt(0.5);
    const TickOutput tick =
        stepper.step(preset, at_position(1e-3 * i, Vec3(out, out * std::cos(turn), out * std::sin(turn))), state);
    on_the_rim += tick.status == TickStatus::edge || tick.status == TickStatus::vertex;
    asked += state.clearance.centre != centre;
    centre = state.clearance.centre;
  }
  CHECK(on_the_rim == 4000);
  CHECK(asked < 4000 / 5);
  MESSAGE("asked in " << asked << " of 4000 ticks");
}

TEST_CASE(
    "a finger that leaps looks no further ahead than one at rest: what is there would be behind it in the next tick") {
  const ScenePtr scene = scene_of(make_icosphere(0.040, 3));
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.force.contacts = ForceContacts::deepest;
  for (const bool leaps : {false, true}) {
    CAPTURE(leaps);
    Stepper stepper(scene);
    TickState state;
    // 1 mm or 5 mm of the way of a centre 19 mm above the ball; a tenth of that is the most that is looked ahead.
    const double step_rad = (leaps ? 5e-3 : 1e-3) / 0.059;
    for (int i = 0; i < 20; ++i) {
      const double at = step_rad * i;
      const TickOutput out =
          stepper.step(preset, at_position(1e-3 * i, 0.059 * Vec3(std::sin(at), 0.0, std::cos(at))), state);
      if (i == 0) continue;
      CHECK(out.event == TickEvent::none);
      if (i == 1) CHECK((state.clearance.margin_m > 1.8e-3) != leaps);
      if (leaps) CHECK(state.clearance.margin_m < 2.1 * kSmallestWatch * 0.019);
    }
  }
}
