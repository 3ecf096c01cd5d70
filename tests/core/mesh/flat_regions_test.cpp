// Flat caps of many slivers: found, and searched in few steps with the results of a look at every sliver.
#include "core/mesh/flat_regions.h"
#include "core/base/triangle.h"
#include "core/contact/follow/walk.h"
#include "core/mesh/vertex_ring.h"
#include "tests/core/capped_cylinder.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

ContactMesh capped(int n) { return *ContactMesh::build(capped_cylinder(n)); }

/// A place over the top cap, in part beside it, in part at its hub, the corner (40, 0) mm.
Vec3 place_over_cap(Random& random, int i) {
  const Vec3 hub(0.040, 0.0, 0.020);
  if (i % 4 == 0) return hub + random.in_cube(1e-4);
  return {random.in(-0.05, 0.05), random.in(-0.05, 0.05), random.in(0.0, 0.04)};
}

double least_distance(const ContactMesh& mesh, std::uint32_t region, const Vec3& on_plane) {
  double least = 1e300;
  for (const std::uint32_t t : mesh.flat_regions().triangles(region)) {
    const auto p = mesh.positions(t);
    least = std::min(least, closest_point_on_triangle(p[0], p[1], p[2], on_plane).distance2);
  }
  return std::sqrt(least);
}

/// The hub of the top cap, as a corner.
CornerOfTriangle hub_of(const ContactMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (mesh.flat_regions().of(t) != kNone && mesh.normal(t, k).z > 0.9 && mesh.crowded_vertex(mesh.vertex(t, k)))
        return {t, k};
  return {};
}

}  // namespace

TEST_CASE("caps of many slivers are flat regions, those of few and what is not flat are none") {
  const ContactMesh mesh = capped(100);
  const FlatRegions& flat = mesh.flat_regions();
  REQUIRE(flat.count() == 2);
  CHECK(flat.triangles(0).size() == 98);
  CHECK(flat.triangles(1).size() == 98);
  std::uint32_t others = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) others += flat.of(t) == kNone;
  CHECK(others == 200);  // all of the cylinder's side
  CHECK(capped(60).flat_regions().empty());
  CHECK(scene_of(make_torus(0.040, 0.015, 48, 24))->mesh().flat_regions().empty());
}

TEST_CASE("the sliver under a point is found as by a look at all, in few steps") {
  for (const int n : {200, 1600, 12800}) {
    const ContactMesh mesh = capped(n);
    const FlatRegions& flat = mesh.flat_regions();
    REQUIRE(flat.count() == 2);
    const std::uint32_t top = flat.normal(0).z > 0.0 ? 0 : 1;
    Random random(static_cast<std::uint64_t>(n));
    std::size_t most = 0;
    int wrong = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 point = place_over_cap(random, i);
      std::size_t visited = 0;
      const RegionFoot foot = flat.foot(mesh, top, point, &visited);
      most = std::max(most, visited);
      const auto p = mesh.positions(foot.triangle);
      const Vec3 place = p[0] + foot.u * (p[1] - p[0]) + foot.v * (p[2] - p[0]);
      const Vec3 on_plane(point.x, point.y, 0.020);
      wrong += std::abs(glm::distance(place, on_plane) - foot.beside_m) > 1e-12;
      if (n < 12800 || i < 50) wrong += std::abs(foot.beside_m - least_distance(mesh, top, on_plane)) > 1e-12;
    }
    CHECK(wrong == 0);
    CAPTURE(n);
    CAPTURE(most);
    CHECK(most <= 200);
  }
}

TEST_CASE("around a vertex with many slivers a direction finds its edge among a few of them") {
  const ContactMesh mesh = capped(3000);
  const CornerOfTriangle hub = hub_of(mesh);
  REQUIRE(hub.triangle != kNone);
  Random random(7);
  int wrong = 0, most = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 direction = random.in_cube(1.0);
    double greatest = -1e300, found = -1e300;
    const auto along = [&](std::uint32_t t, std::uint32_t k) {
      return glm::dot(unit(mesh.position(t, (k + 1) % 3) - mesh.position(t, k)), direction);
    };
    int visited = 0;
    around_vertex(mesh, hub.triangle, hub.corner,
                  [&](std::uint32_t t, std::uint32_t k) { greatest = std::max(greatest, along(t, k)); });
    around_vertex_towards(
        mesh, hub.triangle, hub.corner, [&](const Vec3&) { return direction; },
        [&](std::uint32_t t, std::uint32_t k) {
          found = std::max(found, along(t, k));
          ++visited;
        });
    wrong += found != greatest;
    most = std::max(most, visited);
  }
  CHECK(wrong == 0);
  CHECK(most <= 10);
}

TEST_CASE("a long step over a cap of slivers ends where it leads to, or on the rim") {
  const ContactMesh mesh = capped(4000);
  const FlatRegions& flat = mesh.flat_regions();
  const std::uint32_t top = flat.normal(0).z > 0.0 ? 0 : 1;
  Random random(8);
  int lost = 0, wrong = 0, on_rim = 0, most = 0;
  for (int i = 0; i < 300; ++i) {
    const auto place = [&] { return Vec3(random.in(-0.027, 0.027), random.in(-0.027, 0.027), 0.020); };
    const RegionFoot from = flat.foot(mesh, top, place());
    const Vec3 to = i % 3 == 0 ? 2.0 * place() : place();
    const auto p = mesh.positions(from.triangle);
    const Vec3 start = p[0] + from.u * (p[1] - p[0]) + from.v * (p[2] - p[0]);
    double du = 0.0, dv = 0.0;
    REQUIRE(to_barycentric(mesh, from.triangle, Vec3(to.x, to.y, 0.020) - start, du, dv));
    const WalkResult walk = walk_face(mesh, from.triangle, from.u, from.v, du, dv, 64);
    lost += walk.lost;
    most = std::max(most, walk.triangle_changes);
    on_rim += walk.place.feature == Feature::edge;
    const auto q = mesh.positions(walk.place.triangle);
    const Vec3 end = q[0] + walk.place.u * (q[1] - q[0]) + walk.place.v * (q[2] - q[0]);
    const double beyond = std::hypot(to.x, to.y) - 0.040;
    if (beyond < -1e-6) wrong += glm::distance(end, Vec3(to.x, to.y, 0.020)) > 1e-9;
    if (beyond > 0.0) wrong += walk.place.feature != Feature::edge || std::abs(std::hypot(end.x, end.y) - 0.040) > 1e-6;
  }
  CHECK(lost == 0);
  CHECK(wrong == 0);
  CHECK(on_rim > 20);
  CHECK(most <= 17);
}
