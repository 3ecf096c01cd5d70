// Creases do not crack: both sides of every crease edge run along the same curve.
#include "core/contact/patch_cache.h"
#include "core/surface/mesh_patch.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Cracks {
  int edges = 0, darts = 0;
  double widest = 0.0;  ///< relative to the mesh's size
};

int feature_edges_at(const ContactMesh& mesh, std::uint32_t vertex) {
  int count = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::uint32_t k = 0; mesh.usable(t) && k < 3; ++k) {
      if (mesh.edge_kind(t, k) == EdgeKind::smooth) continue;
      const EdgeLink other = mesh.across(t, k);
      if (other.triangle != kNone && other.triangle < t) continue;
      count += mesh.vertex(t, k) == vertex || mesh.vertex(t, (k + 1) % 3) == vertex;
    }
  return count;
}

Cracks widest_crack(const ContactMesh& mesh, EdgeKind kind, bool count_darts) {
  Cracks cracks;
  const double size = glm::length(mesh.bounds().size());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    for (std::uint32_t k = 0; mesh.usable(t) && k < 3; ++k) {
      if (mesh.edge_kind(t, k) != kind) continue;
      const EdgeLink other = mesh.across(t, k);
      ++cracks.edges;
      const PnPatch mine = make_patch(mesh, t), theirs = make_patch(mesh, other.triangle);
      for (int i = 0; i <= 64; ++i) {
        const double f = i / 64.0;
        const Vec2 a = edge_point_uv(k, f), b = edge_point_uv(other.edge, 1.0 - f);
        const double gap = glm::length(evaluate_point(mine, a.x, a.y) - evaluate_point(theirs, b.x, b.y));
        cracks.widest = std::max(cracks.widest, gap / size);
      }
      if (!count_darts) continue;
      for (const std::uint32_t corner : {k, (k + 1) % 3})
        cracks.darts += feature_edges_at(mesh, mesh.vertex(t, corner)) == 1;
    }
  }
  return cracks;
}

/// A fold along x = 0 that fades out towards y < 0, so that its crease ends inside the surface.
PolygonMesh fading_fold(double sign) {
  return height_field(0.05, 12, [sign](double x, double y) { return sign * std::abs(x) * std::max(0.0, 40.0 * y); });
}

}  // namespace

TEST_CASE("both sides of every crease of the sharp objects run along the same curve") {
  for (const char* name : {"cube", "cylinder", "cone", "tetrahedron", "octagon", "triangle", "hexagon"}) {
    CAPTURE(std::string(name));
    const auto scene = scene_of(*generate_mesh(name));
    const Cracks cracks = widest_crack(scene->mesh(), EdgeKind::crease, false);
    CHECK(cracks.edges > 0);
    CHECK(cracks.widest <= 1e-15);
  }
}

TEST_CASE("creases that end inside the surface do not crack, folded up or down") {
  for (const double sign : {1.0, -1.0}) {
    const auto scene = scene_of(fading_fold(sign));
    const Cracks cracks = widest_crack(scene->mesh(), EdgeKind::crease, true);
    CHECK(cracks.edges > 0);
    CHECK(cracks.darts > 0);
    CHECK(cracks.widest <= 1e-15);
  }
}

TEST_CASE("file normals that differ more and more along an edge leave no crack") {
  Random random(20);
  for (int i = 0; i < 200; ++i) {
    PolygonMesh mesh;
    mesh.name = "two triangles";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.4, 1, 0.2}, {0.5, -1, 0.1}};
    for (Vec3& p : mesh.positions) p += random.in_cube(0.2);
    mesh.add_face({0, 1, 2});
    mesh.add_face({1, 0, 3});
    for (int k = 0; k < 6; ++k) mesh.normals.push_back(unit(Vec3(0, 0, 1) + random.in_cube(0.9)));
    mesh.corner_normal = {0, 1, 2, 3, 4, 5};
    const auto scene = scene_of(mesh);
    REQUIRE(scene->mesh().edge_kind(0, 0) == EdgeKind::crease);
    CHECK(widest_crack(scene->mesh(), EdgeKind::crease, false).widest <= 1e-15);
  }
}

TEST_CASE("smooth edges of an icosphere and a torus do not crack either, and their normals agree") {
  for (const PolygonMesh& polygons : {make_icosphere(0.040, 2), make_torus(0.040, 0.015, 24, 12)}) {
    const auto scene = scene_of(polygons);
    const ContactMesh& mesh = scene->mesh();
    CHECK(widest_crack(mesh, EdgeKind::smooth, false).widest <= 1e-15);
    double turn = 0.0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const EdgeLink other = mesh.across(t, k);
        for (const double f : {0.0, 0.3, 0.5, 0.9, 1.0}) {
          const Vec2 a = edge_point_uv(k, f), b = edge_point_uv(other.edge, 1.0 - f);
          turn = std::max(turn, glm::length(evaluate_normal(make_patch(mesh, t), a.x, a.y) -
                                            evaluate_normal(make_patch(mesh, other.triangle), b.x, b.y)));
        }
      }
    CHECK(turn <= 1e-14);
  }
}

TEST_CASE("creases and smooth edges of the fandisk do not crack" * doctest::skip(testing::kSanitized)) {
  if (!testing::shared_files_there({"meshes/fandisk.obj"})) return;
  const auto scene = file_scene(testing::shared_file("meshes/fandisk.obj"), 45.0);
  const auto creases = widest_crack(scene->mesh(), EdgeKind::crease, false);
  CHECK(creases.edges > 100);
  CHECK(creases.widest <= 1e-15);
  CHECK(widest_crack(scene->mesh(), EdgeKind::smooth, false).widest <= 1e-15);
}

namespace {

Vec2 turned_by(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

SurfaceSample sample_at(const EdgeFan& fan, const Vec2& turn) {
  SurfaceSample sample;
  edge_sample(fan, turn, sample);
  return sample;
}

}  // namespace

TEST_CASE("the fan of a crease begins at the one face's normal and ends at the other's - a boundary's at its back") {
  for (const char* name : {"cylinder", "cube"}) {
    const auto scene = scene_of(*generate_mesh(name));
    PatchCache cache(scene->mesh());
    const ContactMesh& mesh = scene->mesh();
    int creases = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (mesh.edge_kind(t, k) != EdgeKind::crease) continue;
        ++creases;
        for (const double f : {0.0, 0.25, 1.0}) {
          const EdgeFan fan = cache.fan(t, k, f, NormalForm::bernstein);
          const EdgeLink other = mesh.across(t, k);
          const Vec2 a = edge_point_uv(k, f), b = edge_point_uv(other.edge, 1.0 - f);
          CHECK(glm::length(fan.point - evaluate_point(make_patch(mesh, t), a.x, a.y)) <= 1e-15);
          CHECK(glm::length(sample_at(fan, kNearTurn).normal - evaluate_normal(make_patch(mesh, t), a.x, a.y)) <=
                1e-14);
          CHECK(glm::length(sample_at(fan, fan.far).normal -
                            evaluate_normal(make_patch(mesh, other.triangle), b.x, b.y)) <= 1e-14);
          for (const double turn : {0.2, 0.7}) {
            const double angle = turn * std::atan2(fan.far.y, fan.far.x);
            const SurfaceSample n = sample_at(fan, turned_by(angle));
            CHECK(glm::length(n.normal) == approx(1.0).epsilon(1e-14));
            const Vec3 difference =
                (sample_at(fan, turned_by(angle + 1e-6)).normal - sample_at(fan, turned_by(angle - 1e-6)).normal) /
                2e-6;
            CHECK(glm::length(difference - n.normal_v) <= 1e-8);
          }
        }
      }
    CHECK(creases > 0);
  }

  const auto plate = scene_of(height_field(0.1, 2, [](double, double) { return 0.0; }));
  PatchCache plate_cache(plate->mesh());
  for (std::uint32_t t = 0; t < plate->mesh().triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (plate->mesh().edge_kind(t, k) != EdgeKind::boundary) continue;
      const EdgeFan fan = plate_cache.fan(t, k, 0.5, NormalForm::bernstein);
      CHECK(glm::length(sample_at(fan, kNearTurn).normal - Vec3(0, 0, 1)) <= 1e-15);
      CHECK(glm::length(sample_at(fan, fan.far).normal - Vec3(0, 0, -1)) <= 1e-15);
      CHECK(glm::dot(sample_at(fan, Vec2(0.0, 1.0)).normal, fan.point) > 0.0);  // half way it points off the plate
    }
}

TEST_CASE("a fan is the same, bit for bit, wherever on its edge the cache has been before") {
  for (const char* name : {"cylinder", "cube"}) {
    const auto scene = scene_of(*generate_mesh(name));
    const ContactMesh& mesh = scene->mesh();
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (mesh.edge_kind(t, k) != EdgeKind::crease) continue;
        PatchCache warm(mesh), cold(mesh);
        for (const double f : {0.7, 0.0, 0.3}) warm.fan(t, k, f, NormalForm::bernstein);
        const SurfaceSample a = sample_at(warm.fan(t, k, 0.6, NormalForm::bernstein), Vec2(0.8, 0.6));
        const SurfaceSample b = sample_at(cold.fan(t, k, 0.6, NormalForm::bernstein), Vec2(0.8, 0.6));
        CHECK(a.point == b.point);
        CHECK(a.point_u == b.point_u);
        CHECK(a.normal == b.normal);
        CHECK(a.normal_u == b.normal_u);
        CHECK(a.normal_v == b.normal_v);
      }
  }
}
