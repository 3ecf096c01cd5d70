#include "workbench/gui/render/camera.h"

#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"
#include "workbench/gui/render/scene_renderer.h"

#include <doctest/doctest.h>

#include <array>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr int kWidth = 800, kHeight = 600;

Box cube_box(const Vec3& centre, double half) {
  Box box;
  box.include(centre - Vec3(half));
  box.include(centre + Vec3(half));
  return box;
}

std::shared_ptr<const ContactScene> sphere_scene(const Vec3& offset, double scale) {
  PolygonMesh mesh = make_icosphere(0.040, 2);
  for (Vec3& p : mesh.positions) p = scale * p + offset;
  return ContactScene::build(ContactMesh::build(mesh).value()).value();
}

}  // namespace

TEST_CASE("a pixel's ray passes through the point that projects to it") {
  Camera camera;
  camera.frame(cube_box({1.0, -2.0, 0.5}, 0.04));
  for (const bool y_up : {false, true}) {
    camera.y_up = y_up;
    camera.shift = y_up ? Vec2(0.2, -0.1) : Vec2(0.0);
    for (const Vec3& p : {Vec3(1.01, -2.02, 0.53), Vec3(0.97, -1.99, 0.48), Vec3(1.0, -2.0, 0.5)}) {
      const Vec3 pixel = camera.project(p, kWidth, kHeight);
      CHECK(pixel.z > 0.0);
      CHECK(pixel.z < 1.0);
      const Ray ray = camera.ray_through(Vec2(pixel), kWidth, kHeight);
      CHECK(glm::length(glm::cross(p - ray.origin, ray.direction)) < 1e-12);
    }
  }
}

TEST_CASE("the target is in the middle of the view, and behind the eye nothing is visible") {
  Camera camera;
  camera.frame(cube_box(Vec3(0.0), 0.04));
  const Vec3 middle = camera.project(camera.target, kWidth, kHeight);
  CHECK(middle.x == approx(400.0));
  CHECK(middle.y == approx(300.0));
  CHECK(camera.project(camera.eye() - 0.1 * camera.forward(), kWidth, kHeight).z < 0.0);
}

TEST_CASE("up is up on screen: +z, or +y for meshes that stand on y") {
  Camera camera;
  camera.frame(cube_box(Vec3(0.0), 0.04));
  CHECK(camera.project({0, 0, 0.02}, kWidth, kHeight).y < 290.0);
  camera.y_up = true;
  CHECK(camera.project({0, 0.02, 0}, kWidth, kHeight).y < 290.0);
}

TEST_CASE("a shifted camera sees its target there, whatever its direction, and zooms about the pointer") {
  Camera camera;
  camera.frame(cube_box(Vec3(0.0), 0.04), 1.0, ViewRoom{.width = 0.5, .height = 0.5, .shift = {0.25, 0.1}});
  for (const double by : {0.0, 0.5, 1.1}) {
    camera.orbit(by, 0.3 * by);
    const Vec3 target = camera.project(camera.target, kWidth, kHeight);
    CHECK(target.x == approx(400.0 + 0.25 * kHeight));
    CHECK(target.y == approx(300.0 - 0.1 * kHeight));
  }
  const Vec2 pixel(620.0, 180.0);
  const Ray before = camera.ray_through(pixel, kWidth, kHeight);
  const Vec3 there =
      before.origin + before.direction * (camera.distance_m / glm::dot(before.direction, camera.forward()));
  camera.zoom_at(0.7, pixel, kWidth, kHeight);
  CHECK(glm::length(Vec2(camera.project(there, kWidth, kHeight)) - pixel) < 1e-6);
}

TEST_CASE("of several rooms the one that shows most is framed in, the first of equals") {
  Camera camera;
  const ViewRoom small{.width = 0.4, .height = 0.4, .shift = {0.3, 0.3}},
      large{.width = 0.8, .height = 0.8, .shift = {0.1, 0.1}}, same{.width = 0.8, .height = 0.8, .shift = {-0.1, 0.1}};
  camera.frame(cube_box(Vec3(0.0), 0.04), 1.0, std::array{small, large, same});
  CHECK(camera.shift == large.shift);
}

TEST_CASE("framing shows every corner of the box and wastes little of the view") {
  for (const double size : {1e-6, 0.04, 1e3}) {
    for (const double yaw : {-2.0, 0.0, 0.7}) {
      Camera camera;
      camera.yaw_rad = yaw;
      const Box box = cube_box({5.0 * size, -size, 2.0 * size}, size);
      camera.frame(box, 1.0, ViewRoom{.width = static_cast<double>(kWidth) / kHeight});
      double furthest = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p = box.centre() + size * Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const Vec3 pixel = camera.project(p, kWidth, kHeight);
        CHECK(pixel.z > 0.0);
        CHECK(pixel.z < 1.0);
        furthest = std::max({furthest, std::abs(pixel.x - 400.0) / 400.0, std::abs(pixel.y - 300.0) / 300.0});
      }
      CHECK(furthest == approx(1.0).epsilon(1e-9));
    }
  }
}

TEST_CASE("panning moves the target with the pointer") {
  Camera camera;
  camera.frame(cube_box(Vec3(0.0), 0.04));
  const Vec3 before = camera.target;
  camera.pan(30.0, -20.0, kHeight);
  const Vec3 pixel = camera.project(before, kWidth, kHeight);
  CHECK(pixel.x == approx(430.0).epsilon(1e-6));
  CHECK(pixel.y == approx(280.0).epsilon(1e-6));
}

TEST_CASE("zooming keeps what lies under the pointer at the target's depth, within limits") {
  Camera camera;
  camera.frame(cube_box(Vec3(0.0), 0.04));
  const Vec2 pointer(600.0, 150.0);
  const Ray ray = camera.ray_through(pointer, kWidth, kHeight);
  const Vec3 under = ray.origin + ray.direction * (camera.distance_m / glm::dot(ray.direction, camera.forward()));
  camera.zoom_at(0.5, pointer, kWidth, kHeight);
  const Vec3 pixel = camera.project(under, kWidth, kHeight);
  CHECK(pixel.x == approx(pointer.x).epsilon(1e-9));
  CHECK(pixel.y == approx(pointer.y).epsilon(1e-9));
  for (int i = 0; i < 200; ++i) camera.zoom(0.5);
  CHECK(camera.distance_m > 0.0);
  CHECK(camera.near_m() < camera.far_m());
  for (int i = 0; i < 200; ++i) camera.zoom(2.0);
  CHECK(camera.distance_m <= 50.0 * camera.scene_radius_m);
  const double kept = camera.distance_m;
  camera.zoom(0.0);
  camera.zoom(-1.0);
  CHECK(camera.distance_m == kept);
}

TEST_CASE(
    "fitted points are all in the picture, with as much room on one side as on the other and the least of it where "
    "they are widest") {
  const std::vector<Vec3> points{
      {1.05, -2.0, 0.5}, {0.97, -2.03, 0.48}, {1.0, -1.96, 0.52}, {1.01, -2.0, 0.57}, {0.99, -2.01, 0.47}};
  for (const double margin : {1.0, 1.2}) {
    for (const double yaw : {-2.0, -0.6, 0.3, 1.7}) {
      Camera camera;
      camera.yaw_rad = yaw;
      camera.fit(points, margin, static_cast<double>(kWidth) / kHeight);
      Box drawn;
      for (const Vec3& p : points) drawn.include(camera.project(p, kWidth, kHeight));
      CAPTURE(yaw);
      CHECK(drawn.min.x == approx(kWidth - drawn.max.x).epsilon(1e-6).scale(1.0));
      CHECK(drawn.min.y == approx(kHeight - drawn.max.y).epsilon(1e-6).scale(1.0));
      const double filled = std::max((drawn.max.x - drawn.min.x) / kWidth, (drawn.max.y - drawn.min.y) / kHeight);
      CHECK(filled == approx(1.0 / margin).epsilon(1e-6));
    }
  }
  const Camera before;
  Camera camera;
  camera.fit({}, 1.1, 1.3);
  CHECK(camera == before);
}

TEST_CASE("orbiting never passes over the poles") {
  Camera camera;
  for (int i = 0; i < 100; ++i) camera.orbit(0.3, 0.2);
  CHECK(camera.pitch_rad < 1.56);
  CHECK(std::abs(glm::length(camera.up()) - 1.0) < 1e-12);
}

TEST_CASE("a click picks the triangle under the pointer, at any size and distance from the origin") {
  for (const double scale : {1.0, 2.5e-5, 1e4}) {
    for (const Vec3& offset : {Vec3(0.0), Vec3(1000.0 * scale, -500.0 * scale, 0.0)}) {
      const auto scene = sphere_scene(offset, scale);
      const ContactMesh& mesh = scene->mesh();
      Camera camera;
      camera.frame(world_bounds(*scene));
      int seen = 0;
      for (std::uint32_t t = 0; t < mesh.triangle_count(); t += 7) {
        const auto p = mesh.positions(t);
        const Vec3 centroid = mesh.origin() + (p[0] + p[1] + p[2]) / 3.0;
        if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), camera.eye() - centroid) <= 0.0) continue;  // faces away
        const Vec3 pixel = camera.project(centroid, kWidth, kHeight);
        CHECK(pick_triangle(*scene, camera, Vec2(pixel), kWidth, kHeight).triangle == t);
        ++seen;
      }
      CHECK(seen > 10);
      CHECK_FALSE(pick_triangle(*scene, camera, {2.0, 2.0}, kWidth, kHeight));
    }
  }
}
