#include "core/base/triangle.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the closest point of a triangle is no further than any sampled one, and is where its barycentrics say") {
  Random random(100);
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random.in_cube(1.0), b = random.in_cube(1.0), c = random.in_cube(1.0), q = random.in_cube(2.0);
    const TrianglePoint p = closest_point_on_triangle(a, b, c, q);
    CHECK(p.u >= 0.0);
    CHECK(p.v >= 0.0);
    CHECK(p.u + p.v <= 1.0 + 1e-15);
    CHECK(glm::length(p.point - (a + p.u * (b - a) + p.v * (c - a))) <= 1e-15);
    CHECK(p.distance2 == approx(glm::dot(q - p.point, q - p.point)).epsilon(1e-14));
    for (int k = 0; k < 100; ++k) {
      const Vec2 uv = random.barycentric();
      const Vec3 d = q - (a + uv.x * (b - a) + uv.y * (c - a));
      CHECK(p.distance2 <= glm::dot(d, d) + 1e-14);
    }
  }
}

TEST_CASE("the closest point falls on the corner, edge or face whose region holds the query") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const auto at = [&](double x, double y) { return closest_point_on_triangle(a, b, c, {x, y, 0.7}).point; };
  CHECK(glm::length(at(-1, -1) - a) == 0.0);
  CHECK(glm::length(at(2, -0.5) - b) == 0.0);
  CHECK(glm::length(at(-0.5, 2) - c) == 0.0);
  CHECK(glm::length(at(0.3, -1) - Vec3(0.3, 0, 0)) <= 1e-16);
  CHECK(glm::length(at(-1, 0.3) - Vec3(0, 0.3, 0)) <= 1e-16);
  CHECK(glm::length(at(1, 1) - Vec3(0.5, 0.5, 0)) <= 1e-16);
  CHECK(glm::length(at(0.2, 0.3) - Vec3(0.2, 0.3, 0)) <= 1e-16);
}

TEST_CASE("degenerate triangles give a point of theirs") {
  Random random(101);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = random.in_cube(1.0), q = random.in_cube(2.0), d = random.in_cube(1.0);
    CHECK(glm::length(closest_point_on_triangle(a, a, a, q).point - a) == 0.0);
    for (const double k : {0.0, 0.5, 1.0, 2.0, -1.0}) {
      const TrianglePoint p = closest_point_on_triangle(a, a + d, a + k * d, q);
      CHECK(is_finite(p.point));
      CHECK(std::isfinite(p.distance2));
      // On the line, between the ends.
      CHECK(glm::length(glm::cross(p.point - a, d)) <= 1e-14);
      const double t = glm::dot(p.point - a, d) / glm::dot(d, d);
      CHECK(t >= std::min(0.0, k) - 1e-14);
      CHECK(t <= std::max(1.0, k) + 1e-14);
    }
  }
}

TEST_CASE("a needle of aspect 1e9 keeps the distance to its axis") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.5, 1e-9, 0);
  const TrianglePoint p = closest_point_on_triangle(a, b, c, {0.3, 0.2, 0.1});
  CHECK(std::sqrt(p.distance2) == approx(std::sqrt(0.05)).epsilon(1e-8));
}
