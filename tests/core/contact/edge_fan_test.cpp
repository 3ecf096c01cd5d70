// The fan of an edge: how the turn fraction runs from side to side, and edges whose contact is found without iterating.
#include "core/contact/follow/edge.h"
#include "core/contact/patch_cache.h"
#include "core/finger/plane_contact.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

Vec2 turn_at(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A fan of which only the far side is given.
EdgeFan fan_of_angle(double angle) {
  EdgeFan fan;
  fan.far = turn_at(angle);
  fan.cot_half = 1.0 / std::tan(0.5 * angle);
  return fan;
}

}  // namespace

TEST_CASE(
    "the share of a fan rises from 0 on the near side to 1 on the far one, with the derivative it says, from slivers "
    "to half circles") {
  for (const double angle : {1e-6, 0.01, 0.5, 1.5707963267948966, 2.5, 3.1, 3.1415926}) {
    const EdgeFan fan = fan_of_angle(angle);
    CAPTURE(angle);
    CHECK(share_of(fan, kNearTurn) == 0.0);
    CHECK(std::abs(share_of(fan, fan.far) - 1.0) < 1e-9);
    double last = 0.0;
    for (int i = 1; i <= 100; ++i) {
      const double at = angle * i / 100.0, step = 1e-4 * angle;
      const double share = share_of(fan, turn_at(at));
      CHECK(share > last);
      last = share;
      const double slope = (share_of(fan, turn_at(at + step)) - share_of(fan, turn_at(at - step))) / (2.0 * step);
      CHECK(std::abs(slope - share_rate(fan, turn_at(at))) < 1e-6 / angle);
    }
  }
}

TEST_CASE(
    "the contact on a straight edge between flat sides is the nearest point of its line, whatever the plane it starts "
    "from") {
  const ScenePtr scene = scene_of(*generate_mesh("cube"));
  const ContactMesh& mesh = scene->mesh();
  const auto cache = std::make_unique<PatchCache>(mesh);
  Random random(73);
  int tried = 0;
  double worst = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (mesh.edge_kind(t, k) != EdgeKind::crease) continue;
      const double f = random.in(0.1, 0.9);
      const EdgeFan& fan = cache->fan(t, k, f, NormalForm::bernstein);
      REQUIRE(fan.uniform);
      const Vec3 p = mesh.position(t, k), q = mesh.position(t, (k + 1) % 3);
      // A centre over the fan, somewhere along.
      const double foot = random.in(0.05, 0.95), share = random.in(0.1, 0.9);
      const Vec3 centre = p + foot * (q - p) + 0.02 * unit((1.0 - share) * fan.near_normal + share * fan.far_normal);
      const double to = f + uniform_step(fan, centre - fan.point);
      const Vec3 point = uniform_point(fan, to);
      const Vec2 turn = turn_of(fan, centre - point);
      SurfaceSample sample;
      uniform_sample(fan, point, turn, uniform_normal(fan, turn), sample);
      PlaneContact c;
      round_contact(0.02, centre, sample.point, sample.normal, c);
      worst = std::max({worst, std::abs(to - foot), c.error_m / 0.02, std::abs(c.height_m - 0.02) / 0.02,
                        glm::distance(point, p + foot * (q - p)) / 0.02});
      CHECK(in_fan(fan, turn));
      ++tried;
    }
  }
  REQUIRE(tried >= 24);
  CHECK(worst < 1e-14);
}

namespace {

/// A crease between two triangles, with corner normals that lean along it and differ from side to side.
PolygonMesh leaning_crease() {
  PolygonMesh mesh;
  mesh.name = "leaning crease";
  mesh.positions = {{0, 0, 0}, {0.02, 0, 0}, {0.01, -0.015, -0.01}, {0.011, 0.016, -0.008}};
  mesh.normals = {unit({0.3, -0.5, 0.8}), unit({0.1, -0.6, 0.9}), unit({0, -0.6, 0.7}),
                  unit({-0.2, 0.5, 0.8}), unit({0.4, 0.6, 0.7}),  unit({0.1, 0.6, 0.7})};
  mesh.add_face({1, 0, 2});
  mesh.add_face({0, 1, 3});
  mesh.corner_normal = {1, 0, 2, 3, 4, 5};
  return mesh;
}

/// Visits (edge's fan, a place over it) along every crease of a few meshes with curved ones.
template <class Visit>
int over_curved_creases(Visit visit) {
  Random random(75);
  int count = 0;
  for (const PolygonMesh& polygons : {*generate_mesh("cylinder"), *generate_mesh("cone"), leaning_crease()}) {
    const ScenePtr scene = scene_of(polygons);
    const ContactMesh& mesh = scene->mesh();
    const auto cache = std::make_unique<PatchCache>(mesh);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (mesh.edge_kind(t, k) != EdgeKind::crease) continue;
        const EdgeFan& fan = cache->fan(t, k, random.in(0.05, 0.95), NormalForm::bernstein);
        if (fan.uniform || !fan.convex()) continue;
        const double share = random.in(0.1, 0.9);
        const Vec3 between = unit((1.0 - share) * fan.near_normal + share * fan.far_normal);
        visit(fan, fan.point + 0.02 * between + 1e-4 * random.direction());
        ++count;
      }
  }
  return count;
}

}  // namespace

TEST_CASE("the turn of a direction is that of its part across the edge, however long what the frame is made of") {
  double worst = 0.0;
  const int count = over_curved_creases([&](const EdgeFan& fan, const Vec3& centre) {
    for (const Vec3& direction : {centre - fan.point, fan.near_normal, fan.far_normal, fan.e2 - 5.0 * fan.tangent}) {
      const double x = glm::dot(direction, fan.e1), y = glm::dot(direction, fan.e2), length = std::sqrt(x * x + y * y);
      worst = std::max(worst, glm::distance(turn_of(fan, direction), Vec2(x / length, y / length)));
    }
    worst = std::max({worst, std::abs(glm::dot(fan.e1, fan.e2)), std::abs(glm::dot(fan.e1, fan.tangent)),
                      std::abs(glm::length(fan.e1) - 1.0), std::abs(glm::length(fan.e2) - 1.0),
                      glm::distance(turn_of(fan, fan.far_normal), fan.far)});
    CHECK(turn_of(fan, fan.e1).x == approx(1.0));
  });
  REQUIRE(count > 50);
  CHECK(worst < 1e-14);
}

TEST_CASE("a round finger's step and stability on an edge, from the height alone, are those of any finger") {
  double worst = 0.0;
  int unstable = 0;
  const int count = over_curved_creases([&](const EdgeFan& fan, const Vec3& centre) {
    SurfaceSample s;
    edge_sample(fan, clamp_turn(fan, turn_of(fan, centre - fan.point)), s);
    for (const double side : {1.0, -1.0}) {  // the finger outside, and as deep inside
      PlaneContact c;
      round_contact(0.02, fan.point + side * (centre - fan.point), s.point, s.normal, c);
      const ContactJacobian j = round_jacobian(s, c.height_m);
      const EdgeBend bend = edge_bend(s);
      const Stability quick = bend.at_height(c.height_m), full = edge_stability(s, j);
      worst = std::max({worst, std::abs(quick.det / full.det - 1.0),
                        std::abs(quick.trace - full.trace) / (std::abs(full.trace) + 0.02)});
      CHECK(quick.stable() == full.stable());
      unstable += !quick.stable();
      const double step = round_edge_step(bend, c.height_m, side * (centre - fan.point)),
                   newton = newton_step(s, j, c).da;
      worst = std::max(worst, std::abs(step - newton) / (std::abs(newton) + 1e-3));
    }
  });
  REQUIRE(count > 50);
  CHECK(unstable >= count);
  CHECK(worst < 1e-10);
}

TEST_CASE(
    "where the near normal runs along the edge, and where the curve stands still, there is a frame all the same") {
  // A flat patch edge along x, its near normals tilted into it; then control points that all but coincide.
  FanEdge edge;
  EdgeFan fan;
  edge.chord = {0.01, 0.0, 0.0};
  edge.inwards = {0.0, 0.01, 0.0};
  edge.curve.powers = {Vec3(0.0), edge.chord, Vec3(1e-4, 0.0, 1e-3), Vec3(0.0)};
  for (const Vec3& near : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 1e-9), Vec3(1, 1e-8, 0)}) {
    CAPTURE(near.z);
    edge.near = {{unit(near), Vec3(0.0), Vec3(0.0)}, {0, 0, 1}};
    edge.far = {{unit(Vec3(0, 1, 1)), Vec3(1e-3, 0, 0), Vec3(0.0)}, {0, 0, 1}};
    prepare_fan(edge, fan);
    move_fan(edge, 0.0, fan);
    CHECK(is_finite(fan.e1));
    CHECK(std::abs(glm::length(fan.e1) - 1.0) + std::abs(glm::length(fan.e2) - 1.0) +
              std::abs(glm::dot(fan.e1, fan.e2)) <
          1e-12);
    CHECK(glm::length(turn_of(fan, {0.3, 0.4, 0.5})) == approx(1.0));
    CHECK(glm::length(fan.far) == approx(1.0));
  }
  // Normals that almost cancel: the direction of their sum stays accurate.
  edge.near.powers = {1e-8 * unit(Vec3(0.1, -0.2, 1.0)), Vec3(0, 0, 1e-9), Vec3(0.0)};
  prepare_fan(edge, fan);
  move_fan(edge, 0.0, fan);
  CHECK(glm::dot(fan.e1, fan.near_normal) > 0.99);
  edge.curve.powers = {Vec3(0.0), Vec3(0.0), 3.0 * edge.chord, -2.0 * edge.chord};  // stands still at both ends
  edge.near.powers = {Vec3(0, 0, 1), Vec3(0.0), Vec3(0.0)};
  prepare_fan(edge, fan);
  move_fan(edge, 0.0, fan);
  CHECK(glm::distance(fan.tangent, Vec3(1, 0, 0)) < 1e-15);
  CHECK(fan.tangent_f == Vec3(0.0));
  CHECK(glm::length(fan.e1) == approx(1.0));
}

TEST_CASE("flat patches are told from curved ones, and sampled like them to rounding") {
  const ScenePtr scene = scene_of(*generate_mesh("octagon")), round = scene_of(make_icosphere(0.040, 1));
  Random random(74);
  int flat = 0;
  for (const ScenePtr& s : {scene, round}) {
    const ContactMesh& mesh = s->mesh();
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      const PnPatch patch = make_patch(mesh, t, NormalForm::bernstein);
      CHECK(is_flat(patch, 1e-13) == (s == scene));
      if (s != scene) continue;
      ++flat;
      const double u = random.in(0.0, 1.0), v = random.in(0.0, 1.0 - u);
      SurfaceSample quick;
      evaluate_flat(patch, u, v, quick);
      const SurfaceSample full = evaluate(patch, u, v);
      CHECK(glm::distance(quick.point, full.point) < 1e-16);
      CHECK(glm::distance(quick.point_u, full.point_u) + glm::distance(quick.point_v, full.point_v) < 1e-15);
      CHECK(glm::distance(quick.normal, full.normal) < 1e-15);
      CHECK(glm::length(full.normal_u) + glm::length(full.normal_v) < 1e-14);
      // A corner's normal turned by a millionth, or a control point moved by as much of a side, is no flat patch any
      // more.
      PnPatch bent = patch;
      bent.normals[n110] = unit(bent.normals[n110] + 1e-6 * unit(patch.offsets[b030]));
      CHECK_FALSE(is_flat(bent, 1e-13));
      PnPatch bumped = patch;
      bumped.offsets[b111] += 1e-6 * glm::length(patch.offsets[b030]) * patch.normals[n200];
      CHECK_FALSE(is_flat(bumped, 1e-13));
    }
  }
  CHECK(flat > 10);
}

TEST_CASE("on a sharp edge the turn that faces a finger is found in any orientation, with the long side on it, too") {
  Random random(74);
  int uneven = 0;
  for (const auto& [body, shape] : std::vector<std::pair<const char*, FingerShape>>{{"cube", FingerShape::point},
                                                                                    {"cube", FingerShape::sphere},
                                                                                    {"cube", FingerShape::ellipsoid},
                                                                                    {"cube", FingerShape::capsule},
                                                                                    {"cone", FingerShape::ellipsoid},
                                                                                    {"cone", FingerShape::capsule}}) {
    CAPTURE(std::string(body));
    CAPTURE(static_cast<int>(shape));
    const ScenePtr scene = scene_of(*generate_mesh(body));
    const ContactMesh& mesh = scene->mesh();
    PatchCache cache(mesh);
    const Finger finger = finger_of(shape);
    int tried = 0;
    double worst = 0.0;
    while (tried < rounds(2000)) {
      const std::uint32_t t = random.below(mesh.triangle_count()), k = random.below(3);
      if (mesh.edge_kind(t, k) != EdgeKind::crease) continue;
      ++tried;
      const EdgeFan& fan = cache.fan(t, k, random.in(0.0, 1.0), NormalForm::bernstein);
      uneven += !fan.even;
      const double turn = random.in(0.0, std::atan2(fan.far.y, fan.far.x));
      SurfaceSample s;
      edge_sample(fan, {std::cos(turn), std::sin(turn)}, s);
      // Touched there all but: the centre lies outside.
      FingerPose pose{Vec3(0.0), random.orientation()};
      pose.position = s.point + random.in(1e-4, 2e-3) * s.normal - support_point(finger, pose, s.normal);
      edge_sample(fan, facing_turn(fan, finger, pose), s);
      const PlaneContact c = contact_on_plane(finger, pose, s.point, s.normal);
      worst = std::max(worst, std::abs(glm::dot(c.travel, glm::cross(fan.tangent, s.normal))));
    }
    CHECK(worst < 1e-9);
  }
  CHECK(uneven > 0);
}
