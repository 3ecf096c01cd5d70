#include "core/lab/objects/circle_points.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <initializer_list>

#include <numbers>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("circle points lie where sine and cosine put them") {
  for (const int n : {3, 5, 8, 12, 31, 32, 100}) {
    for (int k = -n; k <= 2 * n; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / n;
      const Vec2 p = circle_point(k, n);
      CHECK(p.x == approx(std::cos(angle)).epsilon(1e-14).scale(1.0));
      CHECK(std::abs(p.x - std::cos(angle)) < 1e-14);
      CHECK(std::abs(p.y - std::sin(angle)) < 1e-14);
    }
  }
}

TEST_CASE("mirrored circle points have exactly mirrored coordinates") {
  for (const int n : {3, 7, 12, 32, 90}) {
    for (int k = 0; k < n; ++k) {
      const Vec2 p = circle_point(k, n);
      const Vec2 below = circle_point(-k, n);
      CHECK(below.x == p.x);
      CHECK(below.y == -p.y);
      const Vec2 behind = circle_point(n - 2 * k, 2 * n);  // half a turn minus the angle
      CHECK(behind.x == -p.x);
      CHECK(behind.y == p.y);
      const Vec2 diagonal = circle_point(n - 4 * k, 4 * n);  // a quarter turn minus the angle
      CHECK(diagonal.x == p.y);
      CHECK(diagonal.y == p.x);
    }
  }
}

TEST_CASE("the axes are met exactly") {
  CHECK(circle_point(0, 4) == Vec2(1.0, 0.0));
  CHECK(circle_point(1, 4) == Vec2(0.0, 1.0));
  CHECK(circle_point(2, 4) == Vec2(-1.0, 0.0));
  CHECK(circle_point(3, 4) == Vec2(0.0, -1.0));
}
