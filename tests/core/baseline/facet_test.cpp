#include "core/baseline/facet.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Edge 0.1 m about the origin.
ScenePtr cube() {
  static const ScenePtr scene = [] {
    PolygonMesh mesh;
    mesh.name = "cube";
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back(i & 1 ? 0.05 : -0.05, i & 2 ? 0.05 : -0.05, i & 4 ? 0.05 : -0.05);
    for (const auto& q : std::vector<std::array<std::uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      mesh.add_face({q[0], q[1], q[2]});
      mesh.add_face({q[0], q[2], q[3]});
    }
    return scene_of(mesh);
  }();
  return scene;
}

FacetContact contact(const Vec3& centre) { return facet_contact(cube()->mesh(), cube()->nearest(), centre, 1e-6); }

void check(const Vec3& centre, const Vec3& point, const Vec3& normal, double height) {
  const FacetContact c = contact(centre);
  REQUIRE(c.found);
  CHECK(glm::length(c.hit.point - point) <= 1e-15);
  CHECK(glm::length(c.normal - normal) <= 1e-12);
  CHECK(c.height_m == approx(height).epsilon(1e-12).scale(1e-3));
}

}  // namespace

TEST_CASE("over faces, edges and corners of a cube the facet's normal points from the nearest point to the finger") {
  check({0.01, 0.02, 0.07}, {0.01, 0.02, 0.05}, {0, 0, 1}, 0.02);
  check({0.01, 0.06, 0.06}, {0.01, 0.05, 0.05}, unit(Vec3(0, 1, 1)), 0.01 * std::sqrt(2.0));
  check({0.06, 0.06, 0.07}, {0.05, 0.05, 0.05}, unit(Vec3(1, 1, 2)), 0.01 * std::sqrt(6.0));
  CHECK(contact({0.01, 0.02, 0.07}).feature == Feature::face);
  CHECK(contact({0.01, 0.06, 0.06}).feature == Feature::edge);
  CHECK(contact({0.06, 0.06, 0.07}).feature == Feature::vertex);
}

TEST_CASE("inside the cube the height is negative and the normal still points outwards") {
  check({0.01, 0.02, 0.04}, {0.01, 0.02, 0.05}, {0, 0, 1}, -0.01);
  check({-0.045, 0.02, 0.01}, {-0.05, 0.02, 0.01}, {-1, 0, 0}, -0.005);
}

TEST_CASE("nearer than the tolerance the face's normal is taken, on both sides of it") {
  for (const double off : {-1e-9, 0.0, 1e-9}) check({0.01, 0.02, 0.05 + off}, {0.01, 0.02, 0.05}, {0, 0, 1}, off);
}

TEST_CASE("the pseudonormal of a face, edge and corner of a cube is the angle-weighted mean of the faces") {
  const ContactMesh& mesh = cube()->mesh();
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      Feature feature = Feature::none;
      const Vec3 n = pseudonormal(mesh, t, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, feature);
      CHECK(feature == Feature::vertex);
      CHECK(glm::length(n - unit(mesh.position(t, k))) <= 1e-14);  // all three faces weigh a right angle
    }
    Feature feature = Feature::none;
    const Vec3 inside = pseudonormal(mesh, t, 0.3, 0.3, feature);
    CHECK(feature == Feature::face);
    CHECK(std::max({std::abs(inside.x), std::abs(inside.y), std::abs(inside.z)}) == approx(1.0));
    CHECK(glm::dot(inside, mesh.position(t, 0)) > 0.0);
    pseudonormal(mesh, t, 0.4, 0.0, feature);
    CHECK(feature == Feature::edge);
  }
}

TEST_CASE("force shading interpolates the corner normals at the nearest point") {
  const auto sphere = scene_of(make_icosphere(0.040, 2));
  const ContactMesh& mesh = sphere->mesh();
  Random random(70);
  double facet = 0.0, shaded = 0.0;
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t t = random.below(mesh.triangle_count());
    const Vec2 uv = random.barycentric();
    const Vec3 on = (1.0 - uv.x - uv.y) * mesh.position(t, 0) + uv.x * mesh.position(t, 1) + uv.y * mesh.position(t, 2);
    const Vec3 centre = on + 0.02 * unit(glm::cross(mesh.position(t, 1) - mesh.position(t, 0),
                                                    mesh.position(t, 2) - mesh.position(t, 0)));
    const FacetContact c = facet_contact(mesh, sphere->nearest(), centre, 1e-6);
    const Vec3 n = force_shading_normal(mesh, c);
    const Vec3 expected =
        unit((1.0 - uv.x - uv.y) * mesh.normal(t, 0) + uv.x * mesh.normal(t, 1) + uv.y * mesh.normal(t, 2));
    CHECK(glm::length(n - expected) <= 1e-12);
    facet = std::max(facet, angle_deg(c.normal, unit(on)));
    shaded = std::max(shaded, angle_deg(n, unit(on)));
  }
  CHECK(shaded < 0.2 * facet);
}

TEST_CASE("the facet and force-shading methods report the raw mesh's contact and feature") {
  for (const Method method : {Method::facet, Method::force_shading}) {
    const Preset preset = sphere_preset(0.020, method);
    const TickOutput face = solve_once(cube(), preset, Vec3(0.01, 0.02, 0.069));
    CHECK(face.status == TickStatus::face);
    CHECK(glm::length(face.contact - Vec3(0.01, 0.02, 0.05)) <= 1e-15);
    CHECK(face.penetration_m == approx(0.001));
    CHECK(glm::length(face.force_n - Vec3(0, 0, 0.8)) <= 1e-12);
    CHECK(solve_once(cube(), preset, Vec3(0.01, 0.062, 0.062)).status == TickStatus::edge);
    CHECK(solve_once(cube(), preset, Vec3(0.06, 0.06, 0.06)).status == TickStatus::vertex);
    CHECK(solve_once(cube(), preset, Vec3(0.0, 0.0, 0.08)).status == TickStatus::free);
  }
}

TEST_CASE("force and display each come from the source the preset names: the paper's conditions") {
  const auto sphere = scene_of(make_icosphere(0.040, 2));
  const FingerPose pose{0.0575 * unit(Vec3(0.31, 0.12, 0.9)), Quat(1.0, 0.0, 0.0, 0.0)};
  const auto solve = [&](Method method, ForceSource force, TactileSource tactile) {
    Preset preset = sphere_preset(0.020, method);
    preset.display.travel_m = preset.display.finger_arc_m;
    preset.force.source = force;
    preset.display.source = tactile;
    return solve_once(sphere, preset, pose);
  };
  const TickOutput smooth = solve(Method::robust, ForceSource::method, TactileSource::method);
  const TickOutput facet = solve(Method::facet, ForceSource::method, TactileSource::method);
  const TickOutput shaded = solve(Method::force_shading, ForceSource::method, TactileSource::method);
  REQUIRE(glm::length(smooth.force_n - facet.force_n) > 1e-3);
  REQUIRE(std::abs(smooth.cld_m - facet.cld_m) > 1e-6);
  CHECK(angle_deg(shaded.force_n, facet.force_n) > 0.1);

  struct Condition {
    ForceSource force;
    TactileSource tactile;
    const TickOutput* force_of;
    const TickOutput* cld_of;  // null: held
  };
  for (const Condition& c : {Condition{ForceSource::facet, TactileSource::held, &facet, nullptr},            // C1
                             Condition{ForceSource::force_shading, TactileSource::held, &shaded, nullptr},   // C2
                             Condition{ForceSource::facet, TactileSource::facet, &facet, &facet},            // C3
                             Condition{ForceSource::facet, TactileSource::smooth, &facet, &smooth},          // C4
                             Condition{ForceSource::smooth, TactileSource::smooth, &smooth, &smooth},        // P1
                             Condition{ForceSource::force_shading, TactileSource::facet, &shaded, &facet}})  // P2
    for (const Method method : {Method::robust, Method::facet, Method::force_shading}) {
      const TickOutput out = solve(method, c.force, c.tactile);
      CHECK(glm::length(out.force_n - c.force_of->force_n) == 0.0);
      CHECK(out.cld_m == (c.cld_of ? c.cld_of->cld_m : 0.0));
      // The row describes the method where that is rendered, and else what the force comes from.
      const TickOutput& own = method == Method::robust ? smooth : method == Method::facet ? facet : shaded;
      const bool rendered = c.force_of == &own || c.cld_of == &own;
      const TickOutput& reported = rendered ? own : *c.force_of;
      CHECK(glm::length(out.contact - reported.contact) == 0.0);
      CHECK(glm::length(out.normal - reported.normal) == 0.0);
      CHECK(out.penetration_m == reported.penetration_m);
      CHECK(out.iterations == reported.iterations);
      CHECK(out.event == reported.event);
      // Nothing pushes along another normal than the one that is reported, unless the display alone is the method's.
      if (!rendered || c.force_of == &own) CHECK(angle_deg(out.force_n, out.normal) < 1e-5);
    }
}
