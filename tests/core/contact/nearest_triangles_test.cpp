// The nearest-triangle structure against brute force over all triangles.
#include "core/contact/nearest_triangles.h"
#include "tests/core/capped_cylinder.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

bool before(const NearestHit& a, const NearestHit& b) {
  return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.triangle < b.triangle);
}

std::vector<NearestHit> brute_force(const ContactMesh& mesh, const Vec3& q, double radius) {
  std::vector<NearestHit> hits;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const NearestHit hit = closest_on_triangle(mesh, t, q);
    if (hit.distance_m <= radius) hits.push_back(hit);
  }
  std::sort(hits.begin(), hits.end(), before);
  return hits;
}

bool same(const NearestHit& a, const NearestHit& b) {
  return a.triangle == b.triangle && a.distance_m == b.distance_m && a.u == b.u && a.v == b.v && a.point == b.point;
}

/// Number of queries that differ from brute force in any bit.
int different(const ContactMesh& mesh, const NearestTriangles& nearest, const Vec3& q, double radius) {
  const auto all = brute_force(mesh, q, radius);
  int wrong = 0;
  const NearestHit one = nearest.nearest(q, radius);
  wrong += bool(one) != !all.empty() || (one && !same(one, all[0]));
  std::array<NearestHit, 24> several;
  const std::size_t count = nearest.nearest_several(q, radius, several);
  wrong += count != std::min<std::size_t>(24, all.size());
  for (std::size_t i = 0; i < count && i < all.size(); ++i) wrong += !same(several[i], all[i]);
  return wrong;
}

int different_queries(const ScenePtr& scene, int queries, std::uint64_t seed) {
  Random random(seed);
  const ContactMesh& mesh = scene->mesh();
  const double size = glm::length(mesh.bounds().size());
  int wrong = 0;
  for (int i = 0; i < queries; ++i) {
    const Vec3 q =
        i % 3 == 0 ? random.in_cube(size) : 0.5 * (mesh.bounds().min + mesh.bounds().max) + random.in_cube(0.5 * size);
    wrong += different(mesh, scene->nearest(), q, kInf);
    wrong += different(mesh, scene->nearest(), q, random.in(0.0, 0.3) * size);
  }
  return wrong;
}

/// The same mesh with boxes that are built when they are asked for, in place of Embree.
ScenePtr in_parts(const ScenePtr& scene) {
  auto built = ContactScene::build(ContactMesh(scene->mesh()), {.far_parts = false, .whole_up_to = 0});
  REQUIRE(built.has_value());
  return *built;
}

/// Rays that hit another triangle, or elsewhere, by the two structures.
int different_rays(const ScenePtr& a, const ScenePtr& b, int rays, std::uint64_t seed) {
  Random random(seed);
  const double size = glm::length(a->mesh().bounds().size());
  int wrong = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 from = random.in_cube(size);
    const Vec3 towards = i % 4 == 0 ? Vec3(0.0, 0.0, i % 8 == 0 ? 1.0 : -1.0) : random.direction();
    const auto p = a->nearest().cast(from, towards), q = b->nearest().cast(from, towards);
    wrong += p.triangle != q.triangle || p.distance_m != q.distance_m || p.u != q.u || p.v != q.v;
  }
  return wrong;
}

}  // namespace

TEST_CASE("boxes built on the way find the same nearest triangles as looking at every one, bit for bit") {
  int soups = 0;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    auto built = ContactMesh::build(sample::soup(seed, 4 + static_cast<int>(seed % 20), 3 + static_cast<int>(seed)));
    if (!built) continue;
    auto scene = ContactScene::build(std::move(*built), {.far_parts = false, .whole_up_to = 0});
    REQUIRE(scene.has_value());
    ++soups;
    CHECK(different_queries(*scene, rounds(100), seed) == 0);
  }
  CHECK(soups > 15);
  CHECK(different_queries(in_parts(scene_of(make_icosphere(0.040, 3))), rounds(200), 1) == 0);
  CHECK(different_queries(in_parts(scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3}))), rounds(200), 3) == 0);
  CHECK(different_queries(in_parts(spot_scene(180.0)), rounds(200), 4) == 0);
  CHECK(different(scene_of(make_icosphere(0.040, 2))->mesh(), in_parts(scene_of(make_icosphere(0.040, 2)))->nearest(),
                  Vec3(0.0), kInf) == 0);
}

TEST_CASE("boxes built on the way are hit by rays where Embree is") {
  for (const ScenePtr& scene :
       {scene_of(make_torus(0.040, 0.015, 48, 24)), spot_scene(180.0), scene_of(sample::cube())})
    CHECK(different_rays(scene, in_parts(scene), rounds(2000), 7) == 0);
}

TEST_CASE("the nearest triangles are those of looking at every triangle, bit for bit, on random soups") {
  int soups = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    auto built = ContactMesh::build(sample::soup(seed, 4 + static_cast<int>(seed % 20), 3 + static_cast<int>(seed)));
    if (!built) continue;
    auto scene = ContactScene::build(std::move(*built));
    REQUIRE(scene.has_value());
    ++soups;
    CHECK(different_queries(*scene, rounds(200), seed) == 0);
  }
  CHECK(soups > 30);
}

TEST_CASE("the nearest triangles are those of looking at every triangle, bit for bit, on generated and real meshes") {
  CHECK(different_queries(scene_of(make_icosphere(0.040, 3)), rounds(400), 1) == 0);
  CHECK(different_queries(scene_of(make_torus(0.040, 0.015, 48, 24)), rounds(400), 2) == 0);
  CHECK(different_queries(scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3})), rounds(400), 3) == 0);
  CHECK(different_queries(spot_scene(180.0), rounds(400), 4) == 0);
}

TEST_CASE("the nearest triangle of a body with flat caps of many slivers is as near as by looking at every triangle") {
  const ScenePtr scene = scene_of(capped_cylinder(300));
  const ContactMesh& mesh = scene->mesh();
  REQUIRE(mesh.flat_regions().count() == 2);
  Random random(11);
  int wrong = 0, wrong_rays = 0, hits = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 q = random.in_cube(0.06);
    const NearestHit found = scene->nearest().nearest(q, kInf), best = brute_force(mesh, q, kInf)[0];
    wrong += std::abs(found.distance_m - best.distance_m) > 1e-15;
    wrong += std::abs(closest_on_triangle(mesh, found.triangle, q).distance_m - found.distance_m) > 0.0;
    // Straight down, a ray meets the cap that is under it.
    const auto ray = scene->nearest().cast(q, Vec3(0.0, 0.0, -1.0));
    const bool over = std::hypot(q.x, q.y)<0.0399, beside = std::hypot(q.x, q.y)> 0.0401;
    if (beside) wrong_rays += bool(ray);
    if (!over || std::abs(q.z) < 0.02) continue;
    ++hits;
    wrong_rays += q.z < -0.02 ? bool(ray) : !ray || std::abs(ray.distance_m - (q.z - 0.02)) > 1e-12;
  }
  CHECK(wrong == 0);
  CHECK(wrong_rays == 0);
  CHECK(hits > 20);
}

TEST_CASE("the nearest triangles of the fandisk are those of looking at every triangle, bit for bit") {
  if (!testing::shared_files_there({"meshes/fandisk.obj"})) return;
  CHECK(different_queries(file_scene(testing::shared_file("meshes/fandisk.obj"), 45.0), rounds(200), 5) == 0);
}

TEST_CASE("ties go to the lowest triangle number, at vertices, on edges and at the centre of symmetry") {
  for (const ScenePtr& scene : {scene_of(sample::cube(0.05)), scene_of(make_icosphere(0.040, 2))}) {
    const ContactMesh& mesh = scene->mesh();
    int wrong = different(mesh, scene->nearest(), Vec3(0.0), kInf);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const Vec3 p = mesh.position(t, k), middle = 0.5 * (p + mesh.position(t, (k + 1) % 3));
        for (const double out : {0.5, 1.0, 1.7})
          wrong +=
              different(mesh, scene->nearest(), out * p, kInf) + different(mesh, scene->nearest(), out * middle, kInf);
      }
    CHECK(wrong == 0);
  }
}

TEST_CASE("the radius counts itself: a triangle exactly that far is found, one a bit further is not") {
  const auto plate = scene_of(height_field(1.0, 2, [](double, double) { return 0.0; }));
  for (const double distance : {0.125, 0.1, 1e-9, 3.0}) {
    const Vec3 q(0.25, 0.125, distance);
    CHECK(plate->nearest().nearest(q, distance).distance_m == distance);
    CHECK(!plate->nearest().nearest(q, std::nextafter(distance, 0.0)));
  }
  CHECK(plate->nearest().nearest({0.25, 0.125, 0.0}, 0.0).distance_m == 0.0);
}

TEST_CASE("asking for nothing, with no number or with a negative radius finds nothing") {
  const auto plate = scene_of(height_field(1.0, 2, [](double, double) { return 0.0; }));
  const NearestTriangles& nearest = plate->nearest();
  const double nan = std::nan("");
  CHECK(!nearest.nearest({nan, 0, 0}, kInf));
  CHECK(!nearest.nearest({0, kInf, 0}, kInf));
  CHECK(!nearest.nearest({0, 0, 0}, nan));
  CHECK(!nearest.nearest({0, 0, 0}, -1.0));
  CHECK(nearest.nearest_several({0, 0, 0}, kInf, {}) == 0);
}

TEST_CASE("from a thousand to 1e5 mesh sizes away the nearest triangle is still the exact one") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  Random random(110);
  int wrong = 0;
  for (const double far : {1.0, 40.0, 1000.0, 3900.0})
    for (int i = 0; i < 50; ++i) wrong += different(scene->mesh(), scene->nearest(), far * random.direction(), kInf);
  CHECK(wrong == 0);
}

TEST_CASE("further away still a triangle is found that reaches as far towards the query as any, to 1e-5 mesh sizes") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  const ContactMesh& mesh = scene->mesh();
  Random random(111);
  for (const double far : {1e5, 1e9, 1e15, 1e30})
    for (int i = 0; i < 20; ++i) {
      const Vec3 direction = random.direction();
      const NearestHit hit = scene->nearest().nearest(far * direction, kInf);
      REQUIRE(hit);
      double found = -1.0, furthest = -1.0;
      for (std::uint32_t k = 0; k < 3; ++k)
        found = std::max(found, glm::dot(mesh.position(hit.triangle, k), direction));
      for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
        furthest = std::max(furthest, glm::dot(mesh.vertex_position(v), direction));
      CHECK(found >= furthest - 1e-5 * glm::length(mesh.bounds().size()));
      CHECK(hit.distance_m == approx(far).epsilon(1e-6));
    }
}

TEST_CASE("tiny and huge meshes give the same nearest triangles as those of ordinary size") {
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    PolygonMesh mesh = make_icosphere(0.040, 2);
    for (Vec3& p : mesh.positions) p *= scale;
    CHECK(different_queries(scene_of(mesh), rounds(100), 6) == 0);
  }
}

TEST_CASE("a ray hits the first triangle along it, from outside and from inside, or none") {
  Random random(112);
  for (const ScenePtr& scene :
       {scene_of(make_icosphere(0.040, 2)), scene_of(make_torus(0.040, 0.015, 48, 24)), scene_of(sample::cube(0.05))}) {
    const ContactMesh& mesh = scene->mesh();
    int wrong = 0, hits = 0;
    for (int i = 0; i < rounds(3000); ++i) {
      const Vec3 origin = random.in_cube(0.12), direction = random.direction();
      // Each triangle by solving for its plane and the barycentrics there, leaving out what grazes an edge.
      double first = kInf;
      bool grazes = false;
      for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto [a, b, c] = mesh.positions(t);
        const Mat3 system(b - a, c - a, -direction);
        if (std::abs(glm::determinant(system)) < 1e-14) continue;
        const Vec3 x = glm::inverse(system) * (origin - a);
        const double inside = std::min({x.x, x.y, 1.0 - x.x - x.y});
        if (x.z < -1e-9) continue;
        grazes |= std::abs(inside) < 1e-9 || std::abs(x.z) < 1e-9;
        if (inside >= 0.0) first = std::min(first, x.z);
      }
      if (grazes) continue;
      const auto hit = scene->nearest().cast(origin, direction);
      wrong += bool(hit) != std::isfinite(first);
      if (!hit || !std::isfinite(first)) continue;
      ++hits;
      wrong += std::abs(hit.distance_m - first) > 1e-12;
      const Vec3 at = (1.0 - hit.u - hit.v) * mesh.position(hit.triangle, 0) + hit.u * mesh.position(hit.triangle, 1) +
                      hit.v * mesh.position(hit.triangle, 2);
      wrong += glm::length(at - (origin + hit.distance_m * direction)) > 1e-12;
    }
    CHECK(hits > rounds(3000) / 30);
    CHECK(wrong == 0);
  }
}

TEST_CASE("queries from several threads at once give the same answers as alone") {
  const auto scene = scene_of(make_torus(0.040, 0.015, 48, 24));
  constexpr int kQueries = 2000;
  const auto ask = [&](std::vector<NearestHit>& out, std::vector<double>& rays) {
    Random random(113);
    for (int i = 0; i < kQueries; ++i) {
      const Vec3 q = random.in_cube(0.08);
      out.push_back(scene->nearest().nearest(q, kInf));
      rays.push_back(scene->nearest().cast(q, random.direction()).distance_m);
    }
  };
  std::vector<NearestHit> alone;
  std::vector<double> alone_rays;
  ask(alone, alone_rays);
  std::array<std::vector<NearestHit>, 3> hits;
  std::array<std::vector<double>, 3> rays;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < hits.size(); ++i) threads.emplace_back([&, i] { ask(hits[i], rays[i]); });
  for (std::thread& t : threads) t.join();
  for (std::size_t k = 0; k < hits.size(); ++k) {
    CHECK(rays[k] == alone_rays);
    int wrong = 0;
    for (int i = 0; i < kQueries; ++i)
      wrong += !same(hits[k][static_cast<std::size_t>(i)], alone[static_cast<std::size_t>(i)]);
    CHECK(wrong == 0);
  }
}

TEST_CASE("steppers on several threads over one scene give the same ticks as alone") {
  const auto scene = scene_of(make_torus(0.040, 0.015, 48, 24));
  const auto walk = [&] {
    BitHash hash;
    Random random(114);
    Stepper stepper(scene);
    TickState state;
    const Preset preset = sphere_preset(0.012, Method::robust);
    for (int i = 0; i < rounds(2000); ++i)
      hash.add(stepper.step(
          preset, at_position(1e-3 * i, i % 10 ? state.last_position + random.in_cube(1e-4) : random.in_cube(0.06)),
          state));
    return hash.value();
  };
  const std::uint64_t alone = walk();
  std::array<std::uint64_t, 3> values{};
  std::vector<std::thread> threads;
  for (std::uint64_t& value : values) threads.emplace_back([&value, &walk] { value = walk(); });
  for (std::thread& t : threads) t.join();
  for (const std::uint64_t value : values) CHECK(value == alone);
}
