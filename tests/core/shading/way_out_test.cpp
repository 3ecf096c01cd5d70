// The shortest way out of several planes.
#include "core/shading/way_out.h"
#include "core/shading/force_law.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Planes that stay where they are: normal . x >= offset is outside.
struct FixedPlane {
  Vec3 normal;
  double offset_m;
};

std::vector<RenderPlane> seen_from(const std::vector<FixedPlane>& fixed, const Vec3& finger) {
  std::vector<RenderPlane> planes;
  for (const FixedPlane& f : fixed) planes.push_back({f.normal, f.offset_m - glm::dot(f.normal, finger), 1.0});
  return planes;
}

std::vector<FixedPlane> random_planes(Random& random) {
  std::vector<FixedPlane> planes(1 + random.below(kMostPlanes));
  for (FixedPlane& p : planes) p = {random.direction(), random.in(-0.001, 0.001)};
  if (planes.size() > 1 && random.below(4) == 0) planes[1].normal = -planes[0].normal;  // a slot, or a slab
  if (planes.size() > 2 && random.below(4) == 0) planes[2] = planes[0];                 // two places that have merged
  return planes;
}

}  // namespace

TEST_CASE("the way out of one plane is its depth, of two at right angles the diagonal, of a plane twice that of one") {
  const RenderPlane a{{1, 0, 0}, 1e-3, 1.0}, b{{0, 1, 0}, 2e-3, 1.0}, outside{{0, 0, 1}, -1e-3, 1.0};
  const auto way = [](std::vector<RenderPlane> planes) { return shortest_way_out(planes); };
  CHECK(glm::distance(way({a}), Vec3(1e-3, 0, 0)) < 1e-10);
  CHECK(glm::distance(way({a, b}), Vec3(1e-3, 2e-3, 0)) < 1e-10);
  CHECK(glm::distance(way({a, a, b, outside}), Vec3(1e-3, 2e-3, 0)) < 1e-10);
  CHECK(way({outside}) == Vec3(0.0));
  CHECK(way({}) == Vec3(0.0));
  // In a slot narrower than the finger: to its middle, here 1 mm to the right.
  CHECK(glm::distance(way({{{1, 0, 0}, 3e-3, 1.0}, {{-1, 0, 0}, 1e-3, 1.0}}), Vec3(1e-3, 0, 0)) < 1e-10);
}

TEST_CASE("the way out leads out of every plane, and a shorter one, tried at random, does not") {
  Random random{81};
  int open = 0;
  for (int i = 0; i < rounds(20000); ++i) {
    const auto planes = seen_from(random_planes(random), 1e-3 * random.in_cube(1.0));
    const Vec3 way = shortest_way_out(planes);
    const auto depth_after = [&](const Vec3& d) {
      double most = 0.0;
      for (const RenderPlane& p : planes) most = std::max(most, p.penetration_m - glm::dot(p.normal, d));
      return most;
    };
    if (depth_after(way) > 1e-8 || glm::length(way) > 0.1) continue;  // there is none, or none in reach
    ++open;
    const double least = glm::length(way);
    for (int k = 0; k < 20; ++k) {
      const Vec3 other = way + 0.5 * least * random.in_cube(1.0);
      if (glm::length(other) < 0.999 * least - 1e-7) CHECK(depth_after(other) > 0.0);
    }
  }
  CHECK(open > rounds(20000) / 2);
}

TEST_CASE("with fixed planes the force of all of them changes by at most stiffness times the motion") {
  Random random{82};
  ForceSettings law;  // 8.5 N at most
  int touched = 0;
  double worst = 0.0;
  const auto force = [&](const std::vector<FixedPlane>& planes, const Vec3& finger) {
    const RenderPlane out = plane_of_way_out(shortest_way_out(seen_from(planes, finger)));
    return contact_force(law, out.normal, out.penetration_m, Vec3(0.0));
  };
  for (int i = 0; i < rounds(200000); ++i) {
    const std::vector<FixedPlane> planes = random_planes(random);
    const Vec3 from = 1e-3 * random.in_cube(1.0);
    const Vec3 moved = std::pow(10.0, random.in(-8.0, -2.0)) * random.direction();
    const Vec3 a = force(planes, from), b = force(planes, from + moved);
    touched += a != Vec3(0.0) || b != Vec3(0.0);
    const double most = law.stiffness_n_per_m * glm::length(moved);
    worst = std::max(worst, glm::distance(a, b) - most);
    CHECK(glm::distance(a, b) <= most * (1.0 + 1e-6) + 1e-7);
    CHECK(glm::length(a) <= law.limit_n * (1.0 + 1e-12));
  }
  CHECK(touched > rounds(200000) / 2);
  MESSAGE("largest change over stiffness times motion: " << worst << " N");
}
