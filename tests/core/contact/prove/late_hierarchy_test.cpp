// A search in parts skips no triangle that holds a contact, and builds what it comes to and no more.
#include "core/contact/prove/late_hierarchy.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <set>
#include <span>
#include <vector>

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
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    bool visited = false;
    ContactHierarchy::build(mesh, std::array{t}).visit(query, [&](std::uint32_t, ContactQuery&) {
      return visited = true;
    });
    count += visited && !seen.contains(t);
  }
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

TEST_CASE("what is built of a mesh in parts changes neither which triangles a search visits nor their order") {
  Random random(16);
  for (const PolygonMesh& source : {make_icosphere(0.040, 5), make_torus(0.040, 0.015, 96, 48)}) {
    const auto scene = scene_of(source);
    const TriangleClusters clusters = TriangleClusters::build(scene->mesh());
    const LateHierarchy all(scene->mesh(), &clusters);
    for (std::size_t part = 0; part < all.part_count(); ++part) all.build_part(part);
    int different = 0, shrunk = 0;
    for (int i = 0; i < rounds(200); ++i) {
      const ContactQuery query = random_query(random, scene->mesh());
      const bool shrinks = random.in(0.0, 1.0) < 0.5;
      const auto visited = [&](const LateHierarchy& hierarchy) {
        std::vector<std::uint32_t> triangles;
        hierarchy.visit(query, [&](std::uint32_t t, ContactQuery& q) {
          triangles.push_back(t);
          if (shrinks) q.margin_m *= 0.9, q.nearest_m *= 0.99;
          return true;
        });
        return triangles;
      };
      const LateHierarchy fresh(scene->mesh(), &clusters);
      const std::vector<std::uint32_t> first = visited(fresh);  // builds what it comes to
      different += first != visited(all) || first != visited(fresh);
      shrunk += shrinks && !first.empty();
    }
    CHECK(different == 0);
    CHECK(shrunk >= rounds(20));
  }
}

TEST_CASE("an outline about several parts rules out no search that one of them doesn't rule out") {
  Random random(17);
  const auto scene = scene_of(make_torus(0.040, 0.015, 96, 48));
  const TriangleClusters clusters = TriangleClusters::build(scene->mesh());
  std::vector<ContactHierarchy::Outline> parts;
  for (std::size_t part = 0; part < clusters.count(); ++part)
    parts.push_back(ContactHierarchy::build(scene->mesh(), clusters.triangles(part)).outline());
  int wrong = 0, ruled_out = 0;
  for (int i = 0; i < rounds(300); ++i) {
    const auto query = random_query(random, scene->mesh());
    const auto first = static_cast<std::size_t>(random.in(0.0, static_cast<double>(parts.size() - 4)));
    const auto four = std::span(parts).subspan(first, 4);
    const auto about = ContactHierarchy::Outline::about(ContactHierarchy::Outline::about(four[0], four[1]),
                                                        ContactHierarchy::Outline::about(four[2], four[3]));
    if (!about.rules_out(query)) continue;
    ++ruled_out;
    for (const auto& part : four) wrong += !part.rules_out(query);
  }
  CHECK(wrong == 0);
  CHECK(ruled_out >= rounds(50));
}
