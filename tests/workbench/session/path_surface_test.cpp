#include "workbench/session/path_surface.h"

#include "core/lab/objects/generate.h"
#include "workbench/session/exploration_path.h"
#include "workbench/session/two_threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tangent;

namespace {

/// A torus about z, of 600,000 triangles, of which nothing is built yet.
std::shared_ptr<const ContactScene> large_torus() {
  static const std::shared_ptr<const ContactScene> scene = [] {
    auto mesh = ContactMesh::build(make_torus(0.030, 0.010, 1000, 300), {}, run_on_two_threads);
    REQUIRE(mesh);
    auto built = ContactScene::build(std::move(*mesh), {.far_parts = false}, run_on_two_threads);
    REQUIRE(built);
    return *built;
  }();
  return scene;
}

double to_torus(const Vec3& p) { return std::abs(std::hypot(std::hypot(p.x, p.y) - 0.030, p.z) - 0.010); }

}  // namespace

TEST_CASE("the triangles that stand for a mesh are few, lie near every other one, and any large one is among them") {
  // Fine, but for one large triangle that shares its cells with fine ones.
  PolygonMesh source = make_torus(0.030, 0.010, 600, 200);
  const auto first = static_cast<std::uint32_t>(source.positions.size());
  for (const Vec3& p : {Vec3(0.03, 0.0, 0.0105), Vec3(0.0, 0.03, 0.0105), Vec3(-0.03, 0.0, 0.0105)})
    source.positions.push_back(p);
  source.corner_normal.clear();
  source.add_face({first, first + 1, first + 2});
  const auto mesh = ContactMesh::build(source);
  REQUIRE(mesh);
  const PolygonMesh few = spread_triangles(*mesh);
  CHECK(few.face_count() < mesh->triangle_count() / 4);
  const PolygonMesh again = spread_triangles(*mesh, run_on_two_threads);
  CHECK(few.positions == again.positions);

  const auto few_mesh = ContactMesh::build(few);
  REQUIRE(few_mesh);
  const auto nearest = NearestTriangles::build(*few_mesh);
  REQUIRE(nearest);
  const double cell = 0.080 / 128.0;
  double farthest = 0.0, longest = 0.0;
  for (std::uint32_t v = 0; v < mesh->vertex_count(); v += 7) {
    const Vec3 at = mesh->vertex_position(v) - few_mesh->origin();
    farthest = std::max(farthest, nearest->nearest(at, std::numeric_limits<double>::infinity()).distance_m);
  }
  for (std::size_t i = 0; i + 1 < few.positions.size(); i += 3)
    longest = std::max(longest, glm::distance(few.positions[i], few.positions[i + 1]));
  CHECK(farthest < 1.8 * cell);  // the diagonal of a cell
  CHECK(longest > 0.04);
}

TEST_CASE("the path over a large mesh builds none of its search structures, and is as deep as over a small one") {
  const auto scene = large_torus();
  REQUIRE(ContactScene::is_in_parts(scene->mesh(), {}));
  const std::size_t unbuilt = scene->unbuilt_parts();
  REQUIRE(unbuilt > 0);
  for (const double pad : {0.0, 0.005, 0.020}) {
    CAPTURE(pad);
    const ExplorationPath path = ExplorationPath::build(*scene, pad);
    double deepest = -1.0, shallowest = 1.0, longest = 0.0;
    Vec3 last = path.at(0.0, pad, 1e-3).position_m;
    for (double way = 0.0; way < path.length_m(); way += 1e-4) {
      const Vec3 at = path.at(way, pad, 1e-3).position_m;
      const double depth = pad - to_torus(at);
      longest = std::max(longest, glm::distance(at, last));
      if (pad > 0.0) deepest = std::max(deepest, depth), shallowest = std::min(shallowest, depth);
      last = at;
    }
    CHECK(longest < 3e-4);
    CHECK(deepest < 2.5e-3);
    if (pad == 0.005) CHECK(shallowest > 0.0);  // the larger one does not fit through the ring
  }
  CHECK(scene->unbuilt_parts() == unbuilt);
}
