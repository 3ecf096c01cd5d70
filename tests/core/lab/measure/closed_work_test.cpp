#include "core/lab/measure/closed_work.h"

#include "core/lab/objects/generate.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

const Vec3 kUp(0, 0, 1);

ClosedWork around(const ScenePtr& scene, Method method, const Vec3& middle, const Vec3& axis, double radius,
                  int steps = 256) {
  Stepper stepper(scene);
  return work_around(stepper, sphere_preset(0.020, method),
                     circle_of_poses({middle, Quat(1, 0, 0, 0)}, axis, radius, steps));
}

}  // namespace

TEST_CASE("a circle of poses has its radius, lies in its plane and closes") {
  const auto loop = circle_of_poses({Vec3(1, 2, 3), Quat(1, 0, 0, 0)}, unit(Vec3(1, 1, 0)), 0.5, 64);
  REQUIRE(loop.size() == 64);
  Vec3 sum(0.0);
  for (const FingerPose& pose : loop) {
    const Vec3 d = pose.position - Vec3(1, 2, 3);
    CHECK(glm::length(d) == approx(0.5));
    CHECK(std::abs(glm::dot(d, Vec3(1, 1, 0))) < 1e-15);
    sum += d;
  }
  CHECK(glm::length(sum) < 1e-13);
}

TEST_CASE("on a plane the force does no work around a path") {
  const ScenePtr scene = scene_of(height_field(0.04, 8, [](double, double) { return 0.0; }));
  for (const Method method : {Method::robust, Method::facet}) {
    for (const Vec3& axis : {kUp, Vec3(1, 0, 0)}) {
      const ClosedWork work = around(scene, method, Vec3(0.003, 0.002, 0.018), axis, 1e-3);
      CHECK_FALSE(work.broken);
      CHECK(work.peak_energy_j > 0.5 * 800.0 * 1e-6);
      CHECK(work.relative() < 1e-10);
    }
  }
}

TEST_CASE("the work of a force with a curl is found: force shading on a plane with bent normals") {
  // Normals lean along x as y grows: the force at depth 1 mm is 0.8 N (lean y, 0, 1), whose curl along z is -0.8 lean.
  constexpr double kLean = 5.0;  // 1/m
  PolygonMesh mesh = height_field(0.04, 32, [](double, double) { return 0.0; });
  for (const Vec3& p : mesh.positions) mesh.normals.push_back(unit(Vec3(kLean * p.y, 0.0, 1.0)));
  mesh.corner_normal = mesh.corner_position;
  const double radius = 5e-3;
  const ClosedWork work = around(scene_of(mesh), Method::force_shading, Vec3(0.0, 0.0, 0.019), kUp, radius);
  const double area = 3.14159265358979 * radius * radius;
  CHECK(std::abs(work.work_j) == approx(0.8 * kLean * area).epsilon(0.02));
  CHECK(work.relative() == approx(std::abs(work.work_j) / work.peak_energy_j));
}

TEST_CASE("out of contact there is no work") {
  const ClosedWork work = around(scene_of(make_icosphere(0.040, 2)), Method::robust, Vec3(0, 0, 0.080), kUp, 2e-3);
  CHECK(work.work_j == 0.0);
  CHECK(work.peak_energy_j == 0.0);
  CHECK(work.relative() == 0.0);
}
