// Contact and normal are continuous: across smooth edges, through the fans of creases and corners, off a rim.
#include "core/contact/follow/step_rule.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFingerRadius = 0.020, kDepth = 0.0005;

/// Sensitivity of contact and normal to the motion of a sphere's centre, on one patch: the larger of those at the start
/// and at the end of the move.
struct Answer {
  bool stable = false;  ///< well so, here and there
  double contact_m = 0.0, normal = 0.0;
};

Answer answer_at(const PnPatch& patch, Vec2& uv, double h, const Vec3& move) {
  const SurfaceSample s = evaluate(patch, uv.x, uv.y);
  const ContactJacobian j{s.point_u + h * s.normal_u, s.point_v + h * s.normal_v};
  const Stability stability = face_stability(s, j);
  PlaneContact c;
  c.travel = move - glm::dot(move, s.normal) * s.normal;
  const ParameterStep step = newton_step(s, j, c);
  uv += Vec2(step.da, step.db);
  return {stability.det > 0.2 && stability.trace > 0.2, glm::length(step.da * s.point_u + step.db * s.point_v),
          glm::length(step.da * s.normal_u + step.db * s.normal_v)};
}

Answer answer(const PnPatch& patch, Vec2 uv, double h, const Vec3& move) {
  const Answer here = answer_at(patch, uv, h, move), there = answer_at(patch, uv, h, move);
  return {here.stable && there.stable, std::max(here.contact_m, there.contact_m), std::max(here.normal, there.normal)};
}

struct Crossing {
  int crossed = 0, unstable = 0;
  int jumps = 0;     ///< the contact, its normal or its depth moved further than the surface makes it, unmarked
  int restarts = 0;  ///< not followed, but seeded anew and marked so
};

/// Steps across `edges` random smooth edges by 1e-6 m, from one side to the other.
Crossing cross_edges(const ScenePtr& scene, double radius, int edges, Method method) {
  const ContactMesh& mesh = scene->mesh();
  Random random(30);
  Preset preset = sphere_preset(radius, method);
  preset.solver.tolerance_m = 1e-11;
  Stepper stepper(scene);
  Crossing crossing;
  constexpr double kStep = 1e-6;
  while (crossing.crossed + crossing.unstable < edges) {
    const std::uint32_t t = random.below(mesh.triangle_count()), k = random.below(3);
    if (!mesh.usable(t) || !mesh.interior(t) || mesh.edge_kind(t, k) != EdgeKind::smooth) continue;
    const double f = random.in(0.05, 0.95);
    const EdgeLink other = mesh.across(t, k);
    const Vec2 uv = edge_point_uv(k, f), other_uv = edge_point_uv(other.edge, 1.0 - f);
    const PnPatch patch = make_patch(mesh, t);
    const SurfaceSample s = evaluate(patch, uv.x, uv.y);
    const Vec3 along = mesh.position(t, (k + 1) % 3) - mesh.position(t, k);
    const Vec3 across = unit(glm::cross(along, s.normal));  // out of the triangle
    const double h = radius - kDepth;
    const Answer mine = answer(patch, uv, h, -kStep * across),
                 theirs = answer(make_patch(mesh, other.triangle), other_uv, h, kStep * across);
    if (!mine.stable || !theirs.stable) {
      ++crossing.unstable;
      continue;
    }
    ++crossing.crossed;
    const Vec3 centre = mesh.origin() + s.point + h * s.normal;
    TickState state;
    state.plane.feature = Feature::face;
    state.plane.triangle = t;
    state.plane.u = uv.x;
    state.plane.v = std::min(uv.y, 1.0 - uv.x);
    state.plane.point = s.point;
    state.plane.normal = s.normal;
    state.clearance = Clearance::unlimited();  // this is about following
    const TickOutput before = stepper.step(preset, at_position(0.0, centre - kStep * across), state);
    const TickOutput after = stepper.step(preset, at_position(1e-3, centre + kStep * across), state);
    const double contact_m = glm::length(after.contact - before.contact),
                 normal = glm::length(after.normal - before.normal);
    const bool smooth = contact_m <= 1.1 * (mine.contact_m + theirs.contact_m) + 1e-9 &&
                        normal <= 1.1 * (mine.normal + theirs.normal) + 1e-7 &&
                        std::abs(after.penetration_m - before.penetration_m) <= 3.0 * kStep;
    const bool marked = before.event != TickEvent::none || after.event != TickEvent::none;
    crossing.restarts += marked;
    crossing.jumps +=
        !marked && (!smooth || before.status == TickStatus::unconverged || after.status == TickStatus::unconverged);
  }
  MESSAGE(name_of(method) << ": " << crossing.crossed << " edges crossed, " << crossing.unstable
                          << " left out where a side is close to unstable, " << crossing.jumps << " jumps, "
                          << crossing.restarts << " seeded anew");
  return crossing;
}

/// A sharp box 40 x 60 x 80 mm about the origin.
ScenePtr box() {
  static const ScenePtr scene = [] {
    PolygonMesh mesh;
    mesh.name = "box";
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back(i & 1 ? 0.020 : -0.020, i & 2 ? 0.030 : -0.030, i & 4 ? 0.040 : -0.040);
    for (const auto& q : std::vector<std::array<std::uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      mesh.add_face({q[0], q[1], q[2]});
      mesh.add_face({q[0], q[2], q[3]});
    }
    return scene_of(mesh);
  }();
  return scene;
}
const Vec3 kCorner(0.020, 0.030, 0.040);

Preset walking_preset(Method method) {
  Preset preset = sphere_preset(kFingerRadius, method);
  preset.solver.tolerance_m = 1e-8;
  preset.solver.max_iterations = 200;
  return preset;
}

/// Follows a path of contacts (place, direction) and compares every tick with what it must be.
class Walk {
 public:
  Walk(ScenePtr scene, Method method) : scene_(std::move(scene)), stepper_(scene_), preset_(walking_preset(method)) {}

  /// The finger pressed kDepth deep at `point` from direction `normal`.
  void expect(const Vec3& point, const Vec3& normal, TickStatus status) {
    const TickOutput out =
        stepper_.step(preset_, at_position(1e-3 * ticks_, point + (kFingerRadius - kDepth) * normal), state_);
    ++ticks_;
    if (out.status != status) ++wrong_status;
    if (ticks_ > 1 && out.event != TickEvent::none) ++events;
    contact_m = std::max(contact_m, glm::length(out.contact - point));
    normal_off = std::max(normal_off, glm::length(out.normal - normal));
    penetration_m = std::max(penetration_m, std::abs(out.penetration_m - kDepth));
    most_iterations = std::max(most_iterations, out.iterations);
  }
  void check() const {
    CHECK(wrong_status == 0);
    CHECK(events == 0);
    CHECK(contact_m <= 1e-7);
    CHECK(normal_off <= 1e-6);
    CHECK(penetration_m <= 1e-8);
  }

  int wrong_status = 0, events = 0, most_iterations = 0;
  double contact_m = 0.0, normal_off = 0.0, penetration_m = 0.0;

 private:
  ScenePtr scene_;
  Stepper stepper_;
  Preset preset_;
  TickState state_;
  int ticks_ = 0;
};

Vec3 between(const Vec3& a, const Vec3& b, double angle) { return std::cos(angle) * a + std::sin(angle) * b; }
const Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

}  // namespace

TEST_CASE("contact, normal and depth are continuous across the edges of an icosphere and a torus") {
  const auto icosphere = scene_of(make_icosphere(0.040, 2));
  const auto torus = scene_of(make_torus(0.040, 0.015, 48, 24));
  for (const Method method : {Method::newton, Method::robust}) {
    for (const double radius : {0.005, 0.020}) {
      const Crossing a = cross_edges(icosphere, radius, rounds(3000), method);
      CHECK(a.unstable == 0);
      CHECK(a.jumps == 0);
      CHECK(a.restarts == 0);
      const Crossing b = cross_edges(torus, radius, rounds(3000), method);
      CHECK(b.jumps == 0);
      CHECK(b.restarts == 0);
      CHECK(b.crossed > b.unstable);
    }
  }
}

TEST_CASE("across the edges of spot the contact is followed and nothing jumps where both sides are stable") {
  const auto scene = spot_scene(180.0);
  for (const double radius : {0.005, 0.020}) {
    const Crossing c = cross_edges(scene, radius, 5000, Method::robust);
    CHECK(c.jumps == 0);
    CHECK(c.crossed > c.unstable);
    CHECK(c.restarts == 0);
  }
}

TEST_CASE("round a sharp edge of a box the contact stays on the edge while the normal turns from face to face") {
  for (const Method method : kSmoothMethods) {
    for (const double x : {0.0, 0.0137, -0.019}) {
      CAPTURE(name_of(method));
      Walk walk(box(), method);
      const auto at = [&](double y, double z) { return Vec3(x, y, z); };
      for (double y = 0.025; y < 0.030 - 1e-5; y += 1e-5) walk.expect(at(y, 0.040), kZ, TickStatus::face);
      for (double a = 0.001; a < 0.5 * kPi; a += 0.001)
        walk.expect(at(0.030, 0.040), between(kZ, kY, a), TickStatus::edge);
      for (double z = 0.040 - 1e-5; z > 0.035; z -= 1e-5) walk.expect(at(0.030, z), kY, TickStatus::face);
      // And back again.
      for (double a = 0.5 * kPi - 0.001; a > 0.0; a -= 0.001) {
        if (a > 0.5 * kPi - 0.0015) walk.expect(at(0.030, 0.040 - 1e-5), kY, TickStatus::face);
        walk.expect(at(0.030, 0.040), between(kZ, kY, a), TickStatus::edge);
      }
      walk.check();
    }
  }
}

TEST_CASE("along a sharp edge of a box the contact slides on the edge under a tilted finger") {
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    Walk walk(box(), method);
    for (double x = -0.019; x < 0.019; x += 1e-4)
      walk.expect({x, 0.030, 0.040}, between(kZ, kY, 0.8 + 10.0 * x), TickStatus::edge);
    walk.check();
  }
}

TEST_CASE("round the corner of a box the contact stays on the corner while the normal turns among the faces") {
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    Walk walk(box(), method);
    // Along an edge to the corner, over the corner, out along another edge.
    for (double x = 0.015; x < 0.020 - 1e-5; x += 1e-5)
      walk.expect({x, 0.030, 0.040}, between(kZ, kY, 0.7), TickStatus::edge);
    const Vec3 in_edge = between(kZ, kY, 0.7);
    for (double a = 0.002; a < 1.2; a += 0.002) walk.expect(kCorner, between(in_edge, kX, a), TickStatus::vertex);
    walk.check();
  }
}

TEST_CASE("every direction into the octant of a box's corner is a contact at the corner, found from nothing too") {
  Random random(31);
  for (const Method method : kSmoothMethods) {
    const Preset preset = walking_preset(method);
    int wrong = 0;
    double contact_m = 0.0, normal_off = 0.0;
    for (int i = 0; i < rounds(500); ++i) {
      const Vec3 n = unit(glm::abs(random.direction()) + 0.05);
      const TickOutput out = solve_once(box(), preset, kCorner + (kFingerRadius - kDepth) * n);
      wrong += out.status != TickStatus::vertex;
      contact_m = std::max(contact_m, glm::length(out.contact - kCorner));
      normal_off = std::max(normal_off, glm::length(out.normal - n));
    }
    CAPTURE(name_of(method));
    CHECK(wrong == 0);
    CHECK(contact_m <= 1e-15);
    CHECK(normal_off <= 1e-12);
  }
}

TEST_CASE("off the rim of an open plate the normal turns through the fan and the contact stays on the rim") {
  const auto plate = scene_of(height_field(0.050, 5, [](double, double) { return 0.0; }));
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    Walk walk(plate, method);
    for (double x = 0.045; x < 0.050 - 1e-5; x += 1e-5) walk.expect({x, 0.0123, 0.0}, kZ, TickStatus::face);
    for (double a = 0.001; a < 0.9 * kPi; a += 0.002)
      walk.expect({0.050, 0.0123, 0.0}, between(kZ, kX, a), TickStatus::edge);
    walk.check();
  }
}

TEST_CASE("off the corner of an open plate the contact stays on the corner") {
  const auto plate = scene_of(height_field(0.050, 5, [](double, double) { return 0.0; }));
  const Vec3 corner(0.050, 0.050, 0.0), outward = unit(Vec3(1, 1, 0));
  for (const Method method : kSmoothMethods) {
    CAPTURE(name_of(method));
    Walk walk(plate, method);
    for (double x = 0.045; x < 0.050 - 1e-5; x += 1e-5) walk.expect({x, x, 0.0}, kZ, TickStatus::face);
    for (double a = 0.002; a < 0.45 * kPi; a += 0.002) walk.expect(corner, between(kZ, outward, a), TickStatus::vertex);
    walk.check();
  }
}

TEST_CASE("no finger rests on a concave edge: it touches one side or the other, and says face") {
  // A roof upside down: two planes meeting at 90 degrees under the finger.
  const auto valley = scene_of(height_field(0.050, 2, [](double x, double) { return std::abs(x); }));
  const Vec3 origin(0.0, 0.0, 0.0);
  for (const Method method : {Method::newton, Method::robust}) {
    CAPTURE(name_of(method));
    for (const double x : {-0.003, -0.001, 0.001, 0.003}) {
      // The ball of radius R rests in the valley with its centre at height R sqrt 2; pushed in a little.
      const TickOutput out =
          solve_once(valley, walking_preset(method), origin + Vec3(x, 0.004, kFingerRadius * std::sqrt(2.0) - 0.001));
      CHECK(out.status == TickStatus::face);
      CHECK(out.normal.x * x < 0.0);  // the side it is nearer to pushes it back
      CHECK(std::abs(out.normal.x) == approx(std::sqrt(0.5)).epsilon(1e-9));
    }
  }
}
