#include "core/lab/measure/touch_count.h"

#include "tests/core/scenes.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

using namespace tangent;
using namespace tangent::test;
using tangent::testing::contains;

namespace {

/// Over a plate of 80 mm at z = 0, `count` ticks at that height.
std::vector<TickInput> at_height(double z, int count) {
  std::vector<TickInput> motion;
  for (int i = 0; i < count; ++i) motion.push_back(at_position(1e-3 * i, Vec3(1e-5 * i, 0.0, z)));
  return motion;
}

}  // namespace

TEST_CASE("a motion that touches nothing is told with its ticks and how near it came, one that touches ends the look") {
  const ScenePtr scene = scene_of(height_field(0.04, 4, [](double, double) { return 0.0; }));
  const Preset preset = sphere_preset(0.02, Method::paper);
  const TouchCount near = count_until_touched(scene, preset, at_height(0.023, 40));
  CHECK(near.ticks() == 40);
  CHECK(near.touched() == 0);
  CHECK(near.nearest_m() == approx(0.003));
  CHECK(contains(near.note(), "touched nothing in 40 of 40 ticks; the nearest it came was 3 mm: check the units"));
  CHECK(contains(count_until_touched(scene, preset, at_height(59.0, 5)).note(), "was 58.98 m"));

  const TouchCount touched = count_until_touched(scene, preset, at_height(0.019, 40));
  CHECK(touched.ticks() == 1);
  CHECK(touched.touched() == 1);
  CHECK(touched.note().empty());
  CHECK(TouchCount{}.note().empty());
}

TEST_CASE("a far finger whose method does not converge, some planes on the far side, touches nothing") {
  const ScenePtr scene = scene_of(*generate_mesh("torus"));
  const Preset preset = sphere_preset(0.02, Method::paper);
  Stepper stepper(scene);
  TickState state;
  std::vector<TickInput> motion;
  int behind = 0;
  for (int i = 0; i < 200; ++i) {
    motion.push_back(at_position(1e-3 * i, Vec3(0.5 * std::cos(0.05 * i), 0.5 * std::sin(0.05 * i), 0.1)));
    behind += stepper.step(preset, motion.back(), state).penetration_m > 0.0 ? 1 : 0;
  }
  CHECK(behind > 0);
  const TouchCount count = count_until_touched(scene, preset, motion);
  CHECK(count.touched() == 0);
  CHECK(count.nearest_m() > 0.3);
}

TEST_CASE("looking for a touch ends where it is stopped") {
  const ScenePtr scene = scene_of(height_field(0.04, 4, [](double, double) { return 0.0; }));
  const Preset preset = sphere_preset(0.02, Method::robust);
  int asked = 0;
  const auto stop = [&] { return ++asked == 2; };
  CHECK(count_until_touched(scene, preset, at_height(0.05, 5000), stop).ticks() < 1000);
}
