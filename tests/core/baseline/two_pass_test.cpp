#include "core/baseline/two_pass.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

using namespace tangent;
using namespace tangent::test;

namespace {

/// A square plate of 0.2 m in z = 0 whose normals all lean by `lean` along x.
PolygonMesh plate(const Vec3& lean) {
  PolygonMesh mesh;
  mesh.name = "plate";
  mesh.positions = {{-0.1, -0.1, 0}, {0.1, -0.1, 0}, {0.1, 0.1, 0}, {-0.1, 0.1, 0}};
  mesh.normals = {unit(lean)};
  mesh.add_face({0, 1, 2, 3});
  mesh.corner_normal = {0, 0, 0, 0};
  return mesh;
}

TickOutput step_at(const ScenePtr& scene, double radius, const Vec3& at, TickState& state) {
  Stepper stepper(scene);
  return stepper.step(sphere_preset(radius, Method::two_pass), at_position(0.0, at), state);
}

}  // namespace

TEST_CASE("nearest_in: a point stays, and else goes to the plane, the line or the corner nearest to it") {
  const std::array<HalfSpace, 3> octant{{{{1, 0, 0}, 0.0}, {{0, 1, 0}, 0.0}, {{0, 0, 1}, 0.0}}};
  const auto nearest = [&](const Vec3& goal) {
    Vec3 x;
    REQUIRE(nearest_in(octant, goal, x));
    return x;
  };
  CHECK(nearest({1, 2, 3}) == Vec3(1, 2, 3));
  CHECK(glm::length(nearest({-1, 2, 3}) - Vec3(0, 2, 3)) < 1e-15);
  CHECK(glm::length(nearest({-1, -2, 3}) - Vec3(0, 0, 3)) < 1e-15);
  CHECK(glm::length(nearest({-1, -2, -3})) < 1e-15);
  const std::array<HalfSpace, 2> slit{{{{1, 0, 0}, 1.0}, {{-1, 0, 0}, 1.0}}};
  Vec3 x;
  CHECK_FALSE(nearest_in(slit, {0, 0, 0}, x));
}

TEST_CASE("two-pass on a plate with upright normals is the facet's contact") {
  const ScenePtr scene = scene_of(plate({0, 0, 1}));
  for (const double radius : {0.0, 0.020}) {
    TickState state;
    const TickOutput out = step_at(scene, radius, {0.01, 0.02, radius - 0.001}, state);
    CHECK(out.status == TickStatus::face);
    CHECK(glm::length(out.contact - Vec3(0.01, 0.02, 0.0)) < 1e-9);
    CHECK(glm::length(out.normal - Vec3(0, 0, 1)) < 1e-9);
    CHECK(out.penetration_m == approx(0.001).epsilon(1e-9));
  }
}

TEST_CASE("two-pass on a plate with leaning normals: the spring leans by s c per depth, the proxy stays on the plate") {
  const ScenePtr scene = scene_of(plate({0.3, 0, 1}));
  const double s = unit(Vec3(0.3, 0, 1)).x, c = unit(Vec3(0.3, 0, 1)).z, depth = 0.002;
  TickState state;
  const TickOutput out = step_at(scene, 0.020, {0.01, 0.02, 0.020 - depth}, state);
  const Vec3 spring = depth * Vec3(s * c, 0.0, 1.0);
  CHECK(glm::length(out.normal - unit(spring)) < 1e-7);
  CHECK(out.penetration_m == approx(glm::length(spring)).epsilon(1e-9));
  CHECK(glm::length(out.contact - Vec3(0.01 + depth * s * c, 0.02, 0.0)) < 1e-9);
  CHECK(glm::length(out.force_n - 800.0 * spring) < 1e-6);
  CHECK(out.cld_m == approx(0.0).scale(1.0));  // the surface under the proxy is level
}

TEST_CASE("two-pass off the surface is free, with the facet's distance") {
  const ScenePtr scene = scene_of(plate({0.3, 0, 1}));
  TickState state;
  const TickOutput out = step_at(scene, 0.020, {0.01, 0.02, 0.025}, state);
  CHECK(out.status == TickStatus::free);
  CHECK(out.penetration_m == approx(-0.005));
  CHECK(out.force_n == Vec3(0.0));
}

TEST_CASE("the proxy keeps to its side of a thin plate where the nearest face does not") {
  // Two plates 1 mm apart, back to back: a wall.
  PolygonMesh wall;
  wall.name = "wall";
  wall.positions = {{-0.1, -0.1, 0},     {0.1, -0.1, 0},     {0.1, 0.1, 0},     {-0.1, 0.1, 0},
                    {-0.1, -0.1, -1e-3}, {0.1, -0.1, -1e-3}, {0.1, 0.1, -1e-3}, {-0.1, 0.1, -1e-3}};
  wall.add_face({0, 1, 2, 3});
  wall.add_face({7, 6, 5, 4});
  const ScenePtr scene = scene_of(wall);
  Stepper stepper(scene);
  TickState state, facet_state;
  TickOutput out, facet;
  for (int i = 0; i <= 300; ++i) {
    const TickInput input = at_position(1e-3 * i, {1e-4 * i, 0.0, 1e-3 - 1e-5 * i});
    out = stepper.step(sphere_preset(0.0, Method::two_pass), input, state);
    facet = stepper.step(sphere_preset(0.0, Method::facet), input, facet_state);
  }
  CHECK(out.normal.z > 0.999);  // 2 mm deep, still pushed back up
  CHECK(out.penetration_m == approx(2e-3).epsilon(1e-3));
  CHECK(facet.normal.z < -0.999);  // out of the back
}

TEST_CASE("the proxy rolls over the edge of a cube as the finger goes around it, and never enters it") {
  const ScenePtr scene = scene_of(*generate_mesh("cube"));
  const double half = 0.0566 / 2.0, radius = 0.010;
  Stepper stepper(scene);
  TickState state;
  int free_ticks = 0;
  double least_gap = 1.0;
  for (int i = 0; i <= 2000; ++i) {
    // From above the top face, around the edge, to the side: the centre 9 mm off the body, 1 mm deep.
    const double s = -0.010 + 0.034 * i / 2000.0, quarter = 0.009 * 1.5707963267948966;
    Vec3 at;
    if (s < 0.0)
      at = {0.0, half + s, half + 0.009};
    else if (s < quarter)
      at = {0.0, half + 0.009 * std::sin(s / 0.009), half + 0.009 * std::cos(s / 0.009)};
    else
      at = {0.0, half + 0.009, half - (s - quarter)};
    const TickOutput out = stepper.step(sphere_preset(radius, Method::two_pass), at_position(1e-3 * i, at), state);
    free_ticks += out.status == TickStatus::free;
    least_gap =
        std::min(least_gap, facet_contact(scene->mesh(), scene->nearest(), state.proxy, 1e-6).height_m - radius);
    CHECK(out.penetration_m < 1.6e-3);
  }
  CHECK(free_ticks == 0);
  CHECK(least_gap > -1e-6);
}
