#include "devices/placement.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

struct Draw {
  std::mt19937_64 random{7};
  double operator()() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  Vec3 vector() { return {(*this)(), (*this)(), (*this)()}; }
  Quat rotation() { return glm::normalize(Quat((*this)(), (*this)(), (*this)(), (*this)())); }
  Placement placement() { return {.scale = std::exp(3.0 * (*this)()), .rotation = rotation(), .offset_m = vector()}; }
};

bool near(const Vec3& a, const Vec3& b, double size) {
  return glm::length(a - b) <= 8.0 * std::numeric_limits<double>::epsilon() * size;
}

}  // namespace

TEST_CASE("a place of the device and its place in the scene are each other's") {
  Draw draw;
  for (int i = 0; i < 1000; ++i) {
    const Placement p = draw.placement();
    const Vec3 at = draw.vector(), v = draw.vector(), f = draw.vector();
    const double size = 2.0 + 2.0 * std::max(p.scale, 1.0 / p.scale);
    CHECK(near(p.to_device(p.to_scene(at)), at, size));
    CHECK(near(p.velocity_to_device(p.velocity_to_scene(v)), v, size));
    CHECK(near(p.force_to_scene(p.force_to_device(f)), f, size));
    const Quat q = draw.rotation(), back = p.orientation_to_device(p.orientation_to_scene(q));
    CHECK(std::abs(glm::dot(q, back)) == approx(1.0).epsilon(1e-14));
  }
}

TEST_CASE("velocity is the derivative of place, and a spring at the device is scale times the scene's") {
  Draw draw;
  for (int i = 0; i < 100; ++i) {
    const Placement p = draw.placement();
    const Vec3 at = draw.vector(), v = draw.vector();
    constexpr double h = 1e-3;  // the map is linear: any step is exact
    const Vec3 moved = (p.to_scene(at + h * v) - p.to_scene(at)) / h;
    CHECK(near(moved, p.velocity_to_scene(v), 1e4 * (1.0 + p.scale)));
    // A spring of the scene towards its own origin, felt at the device.
    constexpr double k = 300.0;
    const Vec3 before = p.force_to_device(-k * p.to_scene(at)), after = p.force_to_device(-k * p.to_scene(at + v));
    CHECK(near(after - before, -p.felt(k) * v, 1e3 * (1.0 + p.scale) + 1e3));
  }
}

TEST_CASE("power in the scene is the scale times that at the device, work of a closed way is zero in both or in none") {
  Draw draw;
  for (int i = 0; i < 1000; ++i) {
    const Placement p = draw.placement();
    const Vec3 v = draw.vector(), f = draw.vector();
    const double in_scene = glm::dot(f, p.velocity_to_scene(v)), at_device = glm::dot(p.force_to_device(f), v);
    CHECK(std::abs(in_scene - p.scale * at_device) <= 1e-14 * (1.0 + p.scale));
    CHECK(glm::length(p.force_to_device(f)) == approx(glm::length(f)).epsilon(1e-14));
  }
}

TEST_CASE("with the default placement every value keeps its bits, signed zeros, too") {
  Draw draw;
  const Placement p;
  const auto same = [](const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
  for (int i = 0; i < 1000; ++i) {
    Vec3 v = draw.vector() * std::exp(20.0 * draw());
    if (i % 4 == 0) v[i % 3] = -0.0;
    const Quat q = draw.rotation();
    for (const Vec3& w : {p.to_scene(v), p.to_device(v), p.velocity_to_scene(v), p.velocity_to_device(v),
                          p.force_to_scene(v), p.force_to_device(v)})
      CHECK(same(w, v));
    CHECK(same(p.orientation_to_scene(q), q));
    CHECK(same(p.orientation_to_device(q), q));
  }
}

TEST_CASE("a placement after a device's own frame, and taken apart again") {
  Draw draw;
  for (int i = 0; i < 1000; ++i) {
    const Placement p = draw.placement();
    const DeviceFrame frame{draw.rotation(), draw.vector()};
    const Placement map = composed(p, frame);
    const Vec3 at = draw.vector(), world = frame.origin_m + frame.rotation * at;
    const double size = 4.0 + 4.0 * p.scale;
    CHECK(near(map.to_scene(at), p.to_scene(world), size));
    CHECK(near(placement_of(map, frame).to_scene(world), p.to_scene(world), 2.0 * size));
  }
  const Placement p = draw.placement();
  CHECK(composed(p, {}) == p);
  CHECK(placement_of(p, {}) == p);
}

TEST_CASE("a fitted scene fills its share of the tightest axis, and no more of the others") {
  Draw draw;
  const Vec3 workspace(0.19, 0.13, 0.09);
  for (int i = 0; i < 200; ++i) {
    Box scene;
    scene.include(draw.vector());
    scene.include(draw.vector());
    const double finger = 0.01;
    const Placement p = fitted(scene, finger, workspace, draw.rotation(), 0.9);
    Box reached;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at(corner & 1 ? scene.max.x + finger : scene.min.x - finger,
                    corner & 2 ? scene.max.y + finger : scene.min.y - finger,
                    corner & 4 ? scene.max.z + finger : scene.min.z - finger);
      reached.include(p.to_device(at));
    }
    double fullest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      fullest = std::max(fullest, reached.max[axis] / workspace[axis]);
      CHECK(reached.max[axis] == approx(-reached.min[axis]).epsilon(1e-9));
    }
    CHECK(fullest == approx(0.9).epsilon(1e-9));
    CHECK(near(p.to_device(scene.centre()), Vec3(0.0), 1.0));
    CHECK(check_placement(p));
  }
}

TEST_CASE("a workspace without limits leaves the scene's size alone") {
  Box scene;
  scene.include(Vec3(-1.0));
  scene.include(Vec3(3.0));
  CHECK(fitted(scene, 0.02, Vec3(0.0)).scale == 1.0);
  CHECK(fitted(scene, 0.0, Vec3(0.0, 0.5, 0.0), {1, 0, 0, 0}, 1.0).scale == approx(4.0));
}

TEST_CASE("the clutch keeps the finger where it is in the scene") {
  Draw draw;
  for (int i = 0; i < 1000; ++i) {
    const Placement then = draw.placement();
    const Vec3 from = draw.vector(), to = draw.vector();
    const Placement now = clutched(then, from, to);
    CHECK(near(now.to_scene(to), then.to_scene(from), 10.0 * (1.0 + then.scale)));
    CHECK(now.scale == then.scale);
    CHECK(now.rotation == then.rotation);
  }
}

TEST_CASE("a rotation and its angles about x, y and z are each other's") {
  Draw draw;
  const auto same = [](const Quat& a, const Quat& b) { return 1.0 - std::abs(glm::dot(a, b)) < 1e-12; };
  for (int i = 0; i < 1000; ++i) {
    const Quat q = draw.rotation();
    CHECK(same(rotation_from_degrees(degrees_of(q)), q));
    const Vec3 angles = Vec3(170.0, 85.0, 170.0) * draw.vector();
    CHECK(glm::length(degrees_of(rotation_from_degrees(angles)) - angles) < 1e-9);
  }
  for (const double y : {90.0, -90.0}) {
    const Quat q = rotation_from_degrees({20.0, y, 30.0});
    CHECK(same(rotation_from_degrees(degrees_of(q)), q));
  }
  CHECK(rotation_from_degrees(Vec3(0.0)) == Quat(1.0, 0.0, 0.0, 0.0));
  // About x first: y goes to z, which the turn about y then takes to x.
  CHECK(glm::length(rotation_from_degrees({90.0, 90.0, 0.0}) * Vec3(0, 1, 0) - Vec3(1, 0, 0)) < 1e-15);
}

TEST_CASE("a placement that can't be is refused") {
  CHECK(check_placement(Placement{}));
  for (const double scale : {0.0, -1.0, 1e-4, 1e4, kNotANumber})
    CHECK_FALSE(check_placement(Placement{.scale = scale}));
  CHECK_FALSE(check_placement(Placement{.rotation = Quat(1.0, 1.0, 0.0, 0.0)}));
  CHECK_FALSE(check_placement(Placement{.rotation = Quat(kNotANumber, 0.0, 0.0, 0.0)}));
  CHECK_FALSE(check_placement(Placement{.offset_m = Vec3(0.0, kNotANumber, 0.0)}));
}
