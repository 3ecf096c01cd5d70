// Clusters hold every triangle once, few each, and their boxes every patch.
#include "core/contact/triangle_clusters.h"
#include "core/surface/mesh_patch.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Numbers of the clusters whose boxes hold a point.
std::vector<std::uint32_t> holding(const TriangleClusters& clusters, const Vec3& p) {
  std::vector<std::uint32_t> found;
  clusters.tree().visit([&](const Vec3& low, const Vec3& high) { return distance2_to_box(low, high, p); },
                        [] { return 0.0; },
                        [&](std::uint32_t cluster) {
                          found.push_back(cluster);
                          return true;
                        });
  return found;
}

void check_sound(const ContactMesh& mesh, const TriangleClusters& clusters) {
  std::vector<int> times(mesh.triangle_count(), 0);
  int outside = 0;
  for (std::uint32_t c = 0; c < clusters.count(); ++c) {
    const auto triangles = clusters.triangles(c);
    CHECK(!triangles.empty());
    CHECK(triangles.size() <= TriangleClusters::kLargest);
    CHECK(std::is_sorted(triangles.begin(), triangles.end()));
    for (const std::uint32_t t : triangles) {
      ++times[t];
      const PnPatch patch = make_patch(mesh, t);
      for (std::size_t i = 0; i < patch.offsets.size(); ++i) {
        const auto found = holding(clusters, patch.control_point(i));
        outside += std::find(found.begin(), found.end(), c) == found.end();
      }
    }
  }
  CHECK(outside == 0);
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) CHECK(times[t] == (mesh.usable(t) ? 1 : 0));
}

/// A fine ball in a corner of a large box: nearly all triangles in one cell.
PolygonMesh crowded() {
  PolygonMesh mesh = make_icosphere(0.001, 4);
  mesh.normals.clear();
  mesh.corner_normal.clear();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) mesh.positions.push_back(p);
  mesh.add_face({first, first + 2, first + 1});
  mesh.add_face({first, first + 3, first + 2});
  return mesh;
}

}  // namespace

TEST_CASE("clusters hold every usable triangle once and their boxes every control point") {
  for (const PolygonMesh& source : {make_icosphere(0.040, 4), make_torus(0.040, 0.015, 48, 24), crowded(),
                                    *generate_mesh("cube", {.rounding_m = 1.5e-3}), sample::cube(0.05)}) {
    const auto scene = scene_of(source);
    check_sound(scene->mesh(), TriangleClusters::build(scene->mesh()));
  }
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const auto mesh = ContactMesh::build(sample::soup(seed, 4 + static_cast<int>(seed), 30));
    if (mesh) check_sound(*mesh, TriangleClusters::build(*mesh));
  }
}

TEST_CASE("a crowded cell is halved until its clusters are small, the same whoever does the work") {
  const auto scene = scene_of(crowded());
  const TriangleClusters in_turn = TriangleClusters::build(scene->mesh());
  CHECK(in_turn.count() >= 4);
  const auto at_once = [](const std::function<void()>& a, const std::function<void()>& b) {
    std::thread other(b);
    a();
    other.join();
  };
  const TriangleClusters beside = TriangleClusters::build(scene->mesh(), at_once);
  REQUIRE(beside.count() == in_turn.count());
  for (std::size_t c = 0; c < in_turn.count(); ++c) {
    const auto a = in_turn.triangles(c), b = beside.triangles(c);
    CHECK(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
}
