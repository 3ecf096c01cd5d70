#include "workbench/session/stroke_path.h"

#include "tests/support/approx.h"
#include "tests/workbench/session/session_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

std::shared_ptr<const ContactScene> object(const std::string& name, double rounding_m) {
  auto mesh = generate_mesh(name, {.rounding_m = rounding_m});
  REQUIRE(mesh);
  return scene_of(*mesh);
}

StrokePath strokes(const ContactScene& scene, double pad) {
  auto path = StrokePath::build(scene, pad);
  REQUIRE(path);
  return *path;
}

}  // namespace

TEST_CASE("strokes over a sphere go left, right, forward and back down to its equator, each way and back") {
  constexpr double kPad = 0.020, kReach = 0.040 + kPad;
  const auto scene = sphere_scene();
  const StrokePath path = strokes(*scene, kPad);
  // Eight quarters of a circle about the sphere.
  const double quarter = kReach * std::numbers::pi / 2.0;
  CHECK(path.length_m() == approx(8.0 * quarter).epsilon(0.01));
  const auto centre = [&](double quarters) {
    return path.at(quarters / 8.0 * path.length_m(), kPad, 0.0).position_m - scene->mesh().origin();
  };
  const auto near = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1.5e-3; };
  for (const double top : {0.0, 2.0, 4.0, 6.0, 8.0}) CHECK(near(centre(top), {0.0, 0.0, kReach}));
  CHECK(near(centre(1.0), {kReach, 0.0, 0.0}));
  CHECK(near(centre(3.0), {-kReach, 0.0, 0.0}));
  CHECK(near(centre(5.0), {0.0, kReach, 0.0}));
  CHECK(near(centre(7.0), {0.0, -kReach, 0.0}));
}

TEST_CASE("strokes keep the asked-for depth and never leap, over the paper's objects, round and sharp") {
  for (const std::string name : {"sphere", "cone", "cylinder", "cube", "tetrahedron", "octagon", "triangle"}) {
    for (const double rounding : {0.0, 1.5e-3}) {
      if (rounding > 0.0 && name == "sphere") continue;
      CAPTURE(name);
      CAPTURE(rounding);
      constexpr double kPad = 0.020, kPress = 1e-3, kStep = 1e-4;
      const auto scene = object(name, rounding);
      const StrokePath path = strokes(*scene, kPad);
      double deepest = -1.0, shallowest = 1.0, longest = 0.0;
      PathPose last = path.at(0.0, kPad, kPress);
      for (double way = kStep; way < path.length_m(); way += kStep) {
        const PathPose pose = path.at(way, kPad, kPress);
        const auto hit =
            scene->nearest().nearest(pose.position_m - scene->mesh().origin(), std::numeric_limits<double>::infinity());
        deepest = std::max(deepest, kPad - hit.distance_m);
        shallowest = std::min(shallowest, kPad - hit.distance_m);
        longest = std::max(longest, glm::length(pose.position_m - last.position_m));
        last = pose;
      }
      MESSAGE(name << " rounded by " << rounding * 1e3 << " mm: " << path.length_m() << " m of way, depth "
                   << shallowest * 1e3 << " to " << deepest * 1e3 << " mm, longest step " << longest * 1e3 << " mm");
      CHECK(shallowest > 0.99 * kPress);
      CHECK(deepest < 1.02 * kPress);
      CHECK(longest < 1.25 * kStep);  // where the pressing direction turns at a corner
    }
  }
}

TEST_CASE("while it strokes the finger points forward with its pad down") {
  const StrokePath path = strokes(*object("cube", 0.0), 0.010);
  for (const double way : {0.0, 0.05, 0.3}) {
    const Quat q = path.at(way, 0.010, 1e-3).orientation;
    CHECK(glm::length(q * Vec3(1, 0, 0) - Vec3(0, 1, 0)) < 1e-15);
    CHECK(glm::length(q * Vec3(0, 0, -1) - Vec3(0, 0, -1)) < 1e-15);
  }
}

TEST_CASE("strokes close, take any way and any pad, and are the same every time") {
  const auto scene = object("cone", 1.5e-3);
  const StrokePath a = strokes(*scene, 0.010), b = strokes(*scene, 0.010);
  for (const double way : {0.0, 0.017, 0.2}) {
    const Vec3 place = a.at(way, 0.010, 1e-3).position_m;
    CHECK(place == b.at(way, 0.010, 1e-3).position_m);
    CHECK(glm::length(place - a.at(way + a.length_m(), 0.010, 1e-3).position_m) < 1e-12);
    CHECK(glm::length(place - a.at(way - a.length_m(), 0.010, 1e-3).position_m) < 1e-12);
    CHECK(glm::length(place - a.at(way, 0.011, 2e-3).position_m) < 1e-15);
  }
  CHECK(StrokePath::build(*scene, 0.0));
}

TEST_CASE("an object with nothing under the middle of its top is refused with another way to explore it") {
  const auto path = StrokePath::build(*scene_of(make_torus(0.040, 0.015, 48, 24)), 0.001);
  REQUIRE_FALSE(path);
  CHECK(path.error().message().find("explore it around instead") != std::string::npos);
}
