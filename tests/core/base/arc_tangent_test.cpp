#include "core/base/arc_tangent.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the arc tangent is the library's to 1e-15, all round and over sixteen orders of magnitude") {
  Random random(1);
  double apart = 0.0, relative = 0.0;
  for (int i = 0; i < rounds(400'000); ++i) {
    const double y = random.in(-1.0, 1.0) * std::pow(10.0, random.in(-8.0, 8.0));
    const double x = random.in(-1.0, 1.0) * std::pow(10.0, random.in(-8.0, 8.0));
    const double expected = std::atan2(y, x), difference = std::abs(arc_tangent(y, x) - expected);
    apart = std::max(apart, difference);
    relative = std::max(relative, difference / std::abs(expected));
  }
  CHECK(apart <= 1e-15);
  CHECK(relative <= 2e-15);
}

TEST_CASE("on the axes and diagonals the arc tangent is the angle") {
  constexpr double kPi = std::numbers::pi;
  CHECK(arc_tangent(0.0, 0.0) == 0.0);
  CHECK(arc_tangent(0.0, 2.0) == 0.0);
  CHECK(arc_tangent(3.0, 0.0) == 0.5 * kPi);
  CHECK(arc_tangent(-3.0, 0.0) == -0.5 * kPi);
  CHECK(arc_tangent(0.0, -1.0) == kPi);
  CHECK(arc_tangent(-0.0, -1.0) == -kPi);
  CHECK(arc_tangent(1.0, 1.0) == 0.25 * kPi);
  CHECK(arc_tangent(-1.0, -1.0) == -0.75 * kPi);
}
