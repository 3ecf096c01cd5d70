#include "core/mesh/triangle_shape.h"

#include "tests/core/scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a triangle that is far from degenerate is not degenerate where it is moved to") {
  Random random(11);
  int far = 0, near = 0;
  for (int i = 0; i < rounds(200000); ++i) {
    // Slivers of any height, anywhere about a place up to a kilometre away.
    const double side = std::pow(10.0, random.in(-6.0, 0.0)), height = side * std::pow(10.0, random.in(-14.0, 0.0));
    const double away = std::pow(10.0, random.in(-3.0, 3.0));
    const auto anywhere = [&](double size) {
      return size * Vec3(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0));
    };
    const Vec3 at = anywhere(away), along = unit(anywhere(1.0)), up = unit(glm::cross(along, anywhere(1.0)));
    const Vec3 a = at, b = at + side * along, c = at + random.in(0.0, 1.0) * side * along + height * up;
    const Vec3 centre = anywhere(2.0 * away);
    const double reach =
        std::max({std::abs(a.x - centre.x), std::abs(a.y - centre.y), std::abs(a.z - centre.z)}) + side;
    if (!is_far_from_degenerate(a, b, c, reach)) {
      ++near;
      continue;
    }
    ++far;
    REQUIRE_FALSE(is_degenerate(a, b, c));
    const double scale = std::pow(10.0, random.in(-3.0, 3.0));
    REQUIRE_FALSE(is_degenerate((a - centre) * scale, (b - centre) * scale, (c - centre) * scale));
  }
  CHECK(far > rounds(200000) / 10);
  CHECK(near > rounds(200000) / 10);
}
