// Watching for deeper places: asking seldom finds what asking at every tick finds.
#include "core/contact/rivals.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A finger that wanders over two bumps, too large for the valley between them.
std::vector<TickInput> wander(int ticks, double speed_m) {
  std::vector<TickInput> poses;
  for (int i = 0; i < ticks; ++i) {
    const double s = speed_m * i;
    poses.push_back({1e-3 * i, {Vec3(0.006 * std::sin(s / 0.004), 0.004 * std::sin(s / 0.0093), 0.0105), Quat(1.0, 0.0, 0.0, 0.0)}});
  }
  return poses;
}

ScenePtr bumps() {
  return scene_of(height_field(0.020, 60, [](double x, double y) {
    return 0.003 * std::exp(-((x - 0.005) * (x - 0.005) + y * y) / 1.2e-5) + 0.003 * std::exp(-((x + 0.005) * (x + 0.005) + y * y) / 1.2e-5);
  }));
}

}  // namespace

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
  int whole = 0, ticks = 0;
  double rest = -1.0;
  for (const TickInput& input : wander(rounds(20000), 2e-5)) {
    stepper.step(preset, input, state);
    ++ticks;
    whole += state.clearance.margin_m > rest;  // it only shrinks between searches
    rest = state.clearance.margin_m;
  }
  CHECK(whole > 0);
  CHECK(whole < ticks / 4);
}

TEST_CASE("margins wear off by the way of the centre, and by turning where the finger is not round") {
  Clearance fresh;
  fresh.margin_m = 1e-3;
  fresh.height_m = 0.02;
  fresh.watched[0] = {7, 5e-4f};
  const Quat turned = glm::angleAxis(1e-3, Vec3(0.0, 0.0, 1.0));
  Finger sphere, ellipsoid;
  ellipsoid.shape = FingerShape::ellipsoid;

  Clearance c = fresh;
  age(c, sphere, {Vec3(3e-4, 0.0, 0.0), turned});
  CHECK(c.margin_m == doctest::Approx(7e-4).epsilon(1e-12));
  CHECK(c.height_m == doctest::Approx(0.0197).epsilon(1e-12));
  CHECK(c.watched[0].margin_m == doctest::Approx(2e-4).epsilon(1e-5));
  CHECK(!rival_possible(c, 0.0196));
  CHECK(rival_possible(c, 0.0198));
  age(c, sphere, {Vec3(3e-4, 2.1e-4, 0.0), turned});
  CHECK(rival_possible(c, 0.0));  // the watched triangle is due

  c = fresh;
  age(c, ellipsoid, {Vec3(0.0), turned});
  CHECK(c.margin_m < 1e-3 - 1e-3 * 0.020);
  age(c, ellipsoid, {Vec3(0.0), Quat(1.0, 0.0, 0.0, 0.0)});
  age(c, ellipsoid, {Vec3(0.0), glm::angleAxis(1.0, Vec3(0.0, 1.0, 0.0))});
  CHECK(c.margin_m < 0.0);
}

TEST_CASE("unlimited clearance stays so") {
  Clearance c = Clearance::unlimited();
  age(c, Finger{}, {Vec3(1.0, 2.0, 3.0), Quat(1.0, 0.0, 0.0, 0.0)});
  CHECK(!rival_possible(c, 1e9));
}
