#include "workbench/gui/render/surface_mesh.h"

#include "core/lab/objects/generate.h"
#include "core/surface/mesh_patch.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <utility>

using namespace tangent;
using namespace tangent::test;

namespace {

ContactMesh built(std::string_view name, const GenerateOptions& options = {}) {
  return ContactMesh::build(generate_mesh(name, options).value()).value();
}

Vec3 to_vec(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

Vec3 unpacked(std::uint32_t packed) {
  const auto signed_ten = [](std::uint32_t bits) {
    return bits & 0x200u ? static_cast<int>(bits) - 1024 : static_cast<int>(bits);
  };
  return Vec3(signed_ten(packed & 0x3FFu), signed_ten((packed >> 10) & 0x3FFu), signed_ten((packed >> 20) & 0x3FFu)) /
         511.0;
}

SurfaceMesh tessellated(const ContactMesh& mesh, unsigned level, double scale) {
  std::atomic<float> progress{0.0f};
  SurfaceMesh out = tessellate(mesh, NormalForm::bernstein, level, scale, progress);
  CHECK(progress.load() == 1.0f);
  return out;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Welds points nearer than `reach` (they lie on a grid of cells of that size or straddle one) and counts, for
/// every edge of the welded surface, how many triangles use it.
std::map<Edge, int> welded_edge_uses(const SurfaceMesh& surface, double reach) {
  std::map<std::array<long, 3>, std::vector<std::uint32_t>> cells;
  std::vector<Vec3> kept;
  std::vector<std::uint32_t> welded(surface.vertices.size());
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const Vec3 p = to_vec(surface.vertices[i].position);
    const std::array<long, 3> cell{std::lround(p.x / (4 * reach)), std::lround(p.y / (4 * reach)),
                                   std::lround(p.z / (4 * reach))};
    std::uint32_t found = kNone;
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy)
        for (long dz = -1; dz <= 1; ++dz) {
          const auto near = cells.find({cell[0] + dx, cell[1] + dy, cell[2] + dz});
          if (near == cells.end()) continue;
          for (const std::uint32_t k : near->second)
            if (glm::length(kept[k] - p) < reach) found = k;
        }
    if (found == kNone) {
      found = static_cast<std::uint32_t>(kept.size());
      kept.push_back(p);
      cells[cell].push_back(found);
    }
    welded[i] = found;
  }
  std::map<Edge, int> uses;
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = welded[surface.indices[i + k]], b = welded[surface.indices[i + (k + 1) % 3]];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  }
  return uses;
}

}  // namespace

TEST_CASE("tessellated points and normals are core's own at those parameters") {
  const ContactMesh mesh = built("torus");
  const double scale = 0.055;
  const unsigned level = 5;
  const SurfaceMesh surface = tessellated(mesh, level, scale);
  const std::size_t per_patch = (level + 1) * (level + 2) / 2;
  REQUIRE(surface.vertices.size() == per_patch * mesh.triangle_count());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); t += 97) {
    const PnPatch patch = make_patch(mesh, t);
    std::size_t at = per_patch * t;
    for (unsigned j = 0; j <= level; ++j) {
      for (unsigned i = 0; i + j <= level; ++i, ++at) {
        const SurfaceVertex& vertex = surface.vertices[at];
        const double u = i / 5.0, v = j / 5.0;
        CHECK(glm::length(to_vec(vertex.position) - evaluate_point(patch, u, v) / scale) < 1.5e-7);
        CHECK(glm::length(unpacked(vertex.normal) - evaluate_normal(patch, u, v)) < 2e-3);
        CHECK(vertex.weights[0] == static_cast<int>(std::lround(255.0 * u)));
        CHECK(vertex.weights[1] == static_cast<int>(std::lround(255.0 * v)));
      }
    }
  }
}

TEST_CASE("the tessellated surface of a closed mesh is closed, creases included") {
  for (const char* name : {"icosphere", "torus", "cube", "cone", "tetrahedron"}) {
    CAPTURE(name);
    const ContactMesh mesh = built(name);
    const double scale = 0.5 * glm::length(mesh.bounds().size());
    for (const auto& [edge, uses] : welded_edge_uses(tessellated(mesh, 4, scale), 1e-6)) {
      CHECK(edge.first != edge.second);
      CHECK(uses == 2);
    }
  }
}

TEST_CASE("triangles of the surface turn the way the mesh's do") {
  const ContactMesh mesh = built("icosphere");
  const SurfaceMesh surface = tessellated(mesh, 3, 0.04);
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const Vec3 a = to_vec(surface.vertices[surface.indices[i]].position);
    const Vec3 b = to_vec(surface.vertices[surface.indices[i + 1]].position);
    const Vec3 c = to_vec(surface.vertices[surface.indices[i + 2]].position);
    CHECK(glm::dot(glm::cross(b - a, c - a), a + b + c) > 0.0);
  }
}

TEST_CASE("the level keeps the triangles within the budget") {
  CHECK(level_within(300'000, 320) == 30);
  CHECK(level_within(300'000, 69'451) == 2);
  CHECK(level_within(300'000, 5'000'000) == 1);
  CHECK(level_within(300'000, 1) == 64);
  CHECK(level_within(300'000, 0) == 64);
}

TEST_CASE("a stop request ends a tessellation at once, with nothing") {
  const ContactMesh mesh = built("torus");
  std::atomic<float> progress{0.0f};
  std::stop_source stop;
  stop.request_stop();
  CHECK(tessellate(mesh, NormalForm::bernstein, 4, 1.0, progress, stop.get_token()).vertices.empty());
}

TEST_CASE("the stand-in shares a vertex where position and normal agree, and splits it at creases") {
  CHECK(corner_normal_mesh(built("icosphere"), 1.0).vertices.size() == 162);  // 10 * 4^2 + 2
  const ContactMesh cube = built("cube");
  CHECK(corner_normal_mesh(cube, 1.0).vertices.size() > cube.vertex_count());
  CHECK(corner_normal_mesh(cube, 1.0).triangles() == cube.usable_triangle_count());
}

TEST_CASE("the coarse stand-in of a dense mesh keeps to its budget, its shape and its sides") {
  const ContactMesh mesh = ContactMesh::build(make_icosphere(0.040, 6)).value();  // 81,920 triangles
  const double scale = 0.5 * glm::length(mesh.bounds().size());
  for (const std::size_t target : {500u, 5'000u, 20'000u}) {
    const SurfaceMesh coarse = clustered_mesh(mesh, scale, target);
    CHECK(coarse.triangles() <= target);
    CHECK(coarse.triangles() > target / 4);
    for (const SurfaceVertex& vertex : coarse.vertices) {
      const Vec3 p = to_vec(vertex.position) * scale;
      CHECK(glm::length(p) == approx(0.040).epsilon(0.02));
      CHECK(glm::dot(unpacked(vertex.normal), unit(p)) > 0.99);
    }
  }
}

TEST_CASE("facets carry their own normal whatever the unit of the mesh") {
  for (const double size : {1e-6, 1.0, 1e6}) {
    PolygonMesh one;
    one.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
    one.add_face({0, 1, 2});
    const ContactMesh mesh = ContactMesh::build(one).value();
    const auto facets = facet_vertices(mesh, 0.5 * glm::length(mesh.bounds().size()));
    REQUIRE(facets.size() == 3);
    CHECK(glm::length(unpacked(facets[0].face_normal) - Vec3(0, 0, 1)) < 1e-6);
  }
}

TEST_CASE("each crease and boundary edge is listed once") {
  // A sharp cube has 12 edges of 56.6 mm; however they are divided, together they are that long.
  double length = 0.0;
  for (const FeatureEdge& e : feature_edges(built("cube"), 1.0)) {
    CHECK(e.kind == EdgeKind::crease);
    length += glm::length(to_vec(e.b) - to_vec(e.a));
  }
  CHECK(length == approx(12 * 0.0566).epsilon(1e-3));
  PolygonMesh one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.add_face({0, 1, 2});
  const auto edges = feature_edges(ContactMesh::build(one).value(), 1.0);
  REQUIRE(edges.size() == 3);
  CHECK(edges[0].kind == EdgeKind::boundary);
}
