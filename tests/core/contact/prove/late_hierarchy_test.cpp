// A search in parts skips no triangle that holds a contact, and builds what it comes to and no more.
#include "core/contact/prove/late_hierarchy.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <set>

using namespace tangent;
using namespace tangent::test;

namespace {

ContactQuery random_query(Random& random, const ContactMesh& mesh) {
  const double size = glm::length(mesh.bounds().size());
  ContactQuery query;
  query.centre = random.in_cube(0.6 * size);
  query.nearest_m = random.in(0.0, 0.6) * size;
  query.inside_m = random.in(-0.1, 0.3) * size;
  query.margin_m = random.in(0.0, 1.0) < 0.5 ? 0.0 : random.in(0.0, 0.02) * size;
  query.steady_ground = random.in(0.0, 1.0) < 0.5;
  query.tilt_rad = random.in(0.0, 1.0) < 0.7 ? 0.0 : random.in(0.0, 0.5);
  return query;
}

/// Triangles that are skipped though a tree of each alone doesn't rule them out, which is as sharp as bounds get.
std::size_t skipped(const ContactMesh& mesh, const LateHierarchy& hierarchy, const ContactQuery& query) {
  std::set<std::uint32_t> seen;
  hierarchy.visit(query, [&](std::uint32_t t, ContactQuery&) { return seen.insert(t), true; });
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    count += !ContactHierarchy::build(mesh, std::array{t}).rules_out(query) && !seen.contains(t);
  return count;
}

}  // namespace

TEST_CASE("a search in parts skips no triangle that can't be ruled out by itself") {
  Random random(15);
  for (const PolygonMesh& source : {make_icosphere(0.040, 3), make_torus(0.040, 0.015, 32, 16),
                                    *generate_mesh("cube", {.rounding_m = 1.5e-3}), *generate_mesh("octagon")}) {
    const auto scene = scene_of(source);
    const TriangleClusters clusters = TriangleClusters::build(scene->mesh());
    const LateHierarchy hierarchy(scene->mesh(), &clusters);
    std::size_t count = 0;
    for (int i = 0; i < rounds(40); ++i)
      count += skipped(scene->mesh(), hierarchy, random_query(random, scene->mesh()));
    CHECK(count == 0);
  }
}

TEST_CASE("a search builds the parts that it comes to, and a visitor that shrinks its bounds or ends it saves some") {
  const auto scene = scene_of(make_icosphere(0.040, 4));
  const TriangleClusters clusters = TriangleClusters::build(scene->mesh());
  const auto built = [&](auto visitor) {
    const LateHierarchy hierarchy(scene->mesh(), &clusters);
    CHECK(hierarchy.built_count() == 0);
    ContactQuery query;
    query.centre = {0.050, 0.0, 0.0};
    query.nearest_m = 0.030;
    query.inside_m = -1.0;
    hierarchy.visit(query, visitor);
    return hierarchy.built_count();
  };
  const std::size_t all = built([](std::uint32_t, ContactQuery&) { return true; });
  CHECK(all > 10);
  CHECK(all < clusters.count());
  CHECK(built([](std::uint32_t, ContactQuery& q) {
          q.nearest_m = std::min(q.nearest_m, 0.011);
          return true;
        }) < all / 2);
  CHECK(built([](std::uint32_t, ContactQuery&) { return false; }) <= 2);
}
