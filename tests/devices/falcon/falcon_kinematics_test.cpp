// The Falcon's kinematics against their inverse, finite differences and virtual work, over the workspace.
#include "devices/falcon/falcon_kinematics.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Calls `each(place)` for n^3 places over the workspace, its corners included.
template <class Each>
void over_the_workspace(int n, Each&& each) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        each(kFalconCentre_m + kFalconHalfSize_m * (2.0 / (n - 1) * Vec3(i, j, k) - Vec3(1.0)));
}

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

}  // namespace

TEST_CASE("Falcon: on the axis the three motors stand alike, and further out they stand higher") {
  double last = -10.0;
  for (double z = 0.075; z <= 0.175; z += 0.005) {
    const auto angles = falcon_inverse({0.0, 0.0, z});
    REQUIRE(angles);
    CHECK(angles->x == approx(angles->y).epsilon(1e-12));
    CHECK(angles->x == approx(angles->z).epsilon(1e-12));
    CHECK(angles->x > last);
    last = angles->x;
  }
  // A right triangle by hand: the lower leg straight out (z = a sin t + L sin q) at t = 0.
  const auto at_zero = falcon_forward(Vec3(0.0));
  REQUIRE(at_zero);
  const double v = 0.02309 - 0.025, across = 0.060 - (0.01443 - 0.040);
  const double reach = 0.0225 + std::sqrt(0.1025 * 0.1025 - v * v);
  CHECK(at_zero->z == approx(std::sqrt(reach * reach - across * across)).epsilon(1e-12));
  CHECK(std::hypot(at_zero->x, at_zero->y) < 1e-12);
}

TEST_CASE("Falcon: over the whole workspace the position of a position's angles is that position") {
  int places = 0;
  over_the_workspace(15, [&](const Vec3& place) {
    const auto angles = falcon_inverse(place);
    REQUIRE(angles);
    const auto found = falcon_forward(*angles);
    REQUIRE(found);
    CHECK(length(*found - place) < 1e-11);
    ++places;
  });
  CHECK(places == 15 * 15 * 15);
}

TEST_CASE("Falcon: wherever the finger was before, its position is the same") {
  const Vec3 from[]{{0.03, 0.03, 0.15}, {-0.035, 0.01, 0.09}, {0.0, -0.04, 0.12}};
  over_the_workspace(5, [&](const Vec3& place) {
    const auto angles = falcon_inverse(place);
    REQUIRE(angles);
    for (const Vec3& before : from) {
      const auto found = falcon_forward(*angles, before);
      REQUIRE(found);
      CHECK(length(*found - place) < 1e-11);
    }
  });
}

TEST_CASE("Falcon: the Jacobian is the difference quotient over the workspace, in every column") {
  constexpr double kStep_m = 1e-6;
  double worst = 0.0;
  over_the_workspace(9, [&](const Vec3& place) {
    const auto jacobian = falcon_jacobian(place);
    REQUIRE(jacobian);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 aside(0.0);
      aside[axis] = kStep_m;
      const auto after = falcon_inverse(place + aside), before = falcon_inverse(place - aside);
      if (!after || !before) continue;  // beyond the reach of a leg, at a corner
      const Vec3 slope = (*after - *before) / (2.0 * kStep_m);
      worst = std::max(worst, length(slope - (*jacobian)[axis]) / length((*jacobian)[axis]));
    }
  });
  CHECK(worst < 1e-6);
  CHECK(worst > 0.0);
}

TEST_CASE("Falcon: torques do the work that the force does, for every small motion") {
  over_the_workspace(7, [](const Vec3& place) {
    const auto jacobian = falcon_jacobian(place);
    REQUIRE(jacobian);
    const Vec3 force(0.7, -1.3, 2.1);
    const auto torques = falcon_torques(place, force);
    REQUIRE(torques);
    for (const Vec3& motion : {Vec3(1e-3, 0.0, 0.0), Vec3(0.0, 1e-3, 0.0), Vec3(0.0, 0.0, 1e-3)})
      CHECK(glm::dot(*torques, *jacobian * motion) == approx(glm::dot(force, motion)).epsilon(1e-9));
    CHECK(length(*falcon_force(place, *torques) - force) < 1e-9);
  });
}

TEST_CASE("Falcon: equal torques in the middle push along its axis, outwards where the angles grow") {
  const auto force = falcon_force({0.0, 0.0, 0.12}, Vec3(0.1));
  REQUIRE(force);
  CHECK(std::hypot(force->x, force->y) < 1e-12);
  CHECK(force->z > 0.0);
}

TEST_CASE("Falcon: encoders round to the nearest tick, and none wraps") {
  CHECK(falcon_angles({0, 0, 0}).x == approx(35.0 * std::numbers::pi / 180.0));
  CHECK(falcon_angles({1000, 0, -1000}).x - falcon_angles({1000, 0, -1000}).z ==
        approx(72.87 * std::numbers::pi / 180.0));
  CHECK(falcon_encoders(Vec3(1e6)) == FalconEncoders{32767, 32767, 32767});
  CHECK(falcon_encoders(Vec3(-1e6)) == FalconEncoders{-32768, -32768, -32768});
  for (const auto ticks : std::array<std::int16_t, 5>{-2500, -1, 0, 1, 1733}) {
    const FalconEncoders same{ticks, ticks, ticks};
    CHECK(falcon_encoders(falcon_angles(same)) == same);
  }
}

TEST_CASE("Falcon: impossible angles and places are refused, whatever they are") {
  const double nan = std::nan(""), inf = INFINITY;
  CHECK_FALSE(falcon_forward(Vec3(nan, 0.0, 0.0)));
  CHECK_FALSE(falcon_forward(Vec3(0.0), Vec3(inf)));
  CHECK_FALSE(falcon_inverse(Vec3(nan)));
  CHECK_FALSE(falcon_inverse({0.0, 0.0, 0.4}));
  CHECK_FALSE(falcon_jacobian({0.3, 0.0, 0.1}));
  CHECK_FALSE(falcon_torques({0.0, 0.0, 0.4}, Vec3(1.0)));
  CHECK_FALSE(falcon_plausible(Vec3(nan)));
  CHECK_FALSE(falcon_plausible({0.1, 0.0, 0.12}));
  CHECK(falcon_plausible(kFalconCentre_m));
  // Any ticks whatever: a place that has these angles, or none.
  unsigned random = 1;
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    FalconEncoders ticks{};
    for (std::int16_t& tick : ticks) {
      random = random * 1664525u + 1013904223u;
      tick = static_cast<std::int16_t>(random >> 16);
    }
    const auto place = falcon_forward(falcon_angles(ticks));
    if (!place) continue;
    ++found;
    const auto back = falcon_inverse(*place);
    REQUIRE(back);
    CHECK(length(*back - falcon_angles(ticks)) < 1e-8);
  }
  CHECK(found > 0);
}
