#include "core/contact/contact_derivative.h"

#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <random>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Largest deviation of the derivative from central differences over `count` contacts on the scene.
double worst_deviation(const ScenePtr& scene, const Finger& finger, double distance, int count) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Preset preset;
  preset.finger = finger;
  preset.solver.tolerance_m = 1e-13;
  double worst = 0.0;
  int compared = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 direction = unit(Vec3(normal(random), normal(random), normal(random)));
    const FingerPose pose{distance * direction, glm::normalize(Quat(0.9, 0.1, -0.3, 0.2))};
    Stepper stepper(scene);
    TickState state;
    const TickOutput out = stepper.step(preset, {0.0, pose}, state);
    if (out.status == TickStatus::unconverged) continue;
    const ContactDerivative d = contact_derivative(*scene, preset, pose, state.plane);
    REQUIRE(d.valid);
    const double e = 1e-7;
    for (int k = 0; k < 3; ++k) {
      Vec3 step(0.0);
      step[k] = e;
      const auto at = [&](double sign) {
        TickState from = state;
        return stepper.step(preset, {1e-3, {pose.position + sign * step, pose.orientation}}, from);
      };
      const TickOutput plus = at(1.0), minus = at(-1.0);
      if (plus.triangle != minus.triangle || plus.status != minus.status) continue;
      ++compared;
      worst = std::max(worst, glm::length((plus.contact - minus.contact) / (2 * e) - d.contact_by_position[k]));
      worst = std::max(worst, 0.02 * glm::length((plus.normal - minus.normal) / (2 * e) - d.normal_by_position[k]));
      worst = std::max(worst,
                       std::abs((plus.penetration_m - minus.penetration_m) / (2 * e) - d.penetration_by_position[k]));
    }
  }
  CHECK(compared > count);
  return worst;
}

Finger sphere(double radius_m) {
  Finger f;
  f.radius_m = radius_m;
  return f;
}

}  // namespace

TEST_CASE("the derivative of a contact by the finger's position agrees with central differences") {
  const ScenePtr ball = scene_of(make_icosphere(0.04, 2));
  CHECK(worst_deviation(ball, sphere(0.020), 0.0595, 100) < 1e-5);
  Finger point;
  point.shape = FingerShape::point;
  CHECK(worst_deviation(ball, point, 0.0395, 100) < 1e-5);
  Finger ellipsoid;
  ellipsoid.shape = FingerShape::ellipsoid;
  CHECK(worst_deviation(ball, ellipsoid, 0.052, 100) < 1e-5);
}
