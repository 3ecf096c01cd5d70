// How a contact's height follows the finger is what moving the finger and solving again shows, on leaning normals, too.
#include "core/contact/search/height_change.h"
#include "core/base/tolerances.h"
#include "core/contact/follow/step_rule.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A triangle of about 10 mm with corner normals that lean from its own, as on a coarse mesh.
PnPatch coarse_patch(Random& random) {
  const std::array<Vec3, 3> p{Vec3(0.0), Vec3(random.in(0.008, 0.014), 0.0, 0.0),
                              Vec3(random.in(0.0, 0.008), random.in(0.006, 0.012), 0.0)};
  std::array<Vec3, 3> n;
  for (Vec3& x : n) x = unit(Vec3(0.0, 0.0, 1.0) + 0.3 * random.in_cube(1.0));
  return make_pn_patch(p, n);
}

/// Height of the contact near (u, v) for that centre, by Newton's method; NaN where it gets lost.
double solved_height(const PnPatch& patch, double u, double v, const Vec3& centre) {
  Finger finger;
  finger.shape = FingerShape::point;
  const FingerPose pose{centre, Quat(1.0, 0.0, 0.0, 0.0)};
  for (int i = 0; i < 20; ++i) {
    const SurfaceSample s = evaluate(patch, u, v);
    const PlaneContact c = contact_on_plane(finger, pose, s.point, s.normal);
    if (c.error_m < 1e-14) return c.height_m;
    const ParameterStep step = newton_step(s, contact_jacobian(finger, pose, s, c), c);
    u += step.da;
    v += step.db;
  }
  return std::nan("");
}

}  // namespace

TEST_CASE("a contact's height changes at the rate that is told, not along its normal alone") {
  constexpr double kMoved = 1e-6;  // m
  Random random(940);
  int tried = 0, wrong = 0, along_normal_wrong = 0;
  for (int i = 0; i < 3000; ++i) {
    const PnPatch patch = coarse_patch(random);
    const Vec2 uv = random.barycentric();
    const SurfaceSample s = evaluate(patch, uv.x, uv.y);
    const double h = random.in(0.002, 0.020);
    const Stability stability = normal_bend(s).at_height(h);
    if (!stability.stable() || stability.det < 0.2) continue;
    const Vec3 step = kMoved * random.direction(), centre = s.point + h * s.normal;
    const double after = solved_height(patch, uv.x, uv.y, centre + step);
    const double before = solved_height(patch, uv.x, uv.y, centre - step);
    if (std::isnan(after) || std::isnan(before)) continue;
    ++tried;
    const double change = 0.5 * (after - before);
    wrong += std::abs(change - glm::dot(height_change_on_face(s, h).rate, step)) > 1e-3 * kMoved;
    along_normal_wrong += std::abs(change - glm::dot(s.normal, step)) > 0.05 * kMoved;
  }
  CHECK(tried > 1000);
  CHECK(wrong == 0);
  CHECK(along_normal_wrong > tried / 4);
}

TEST_CASE("a rival overtakes no earlier than its margin says, and the margin shrinks towards a fold") {
  const HeightChange still{Vec3(0.0, 0.0, 1.0), 50.0}, leaning{unit(Vec3(0.5, 0.0, 1.0)), 50.0};
  const double gentle = overtaking_margin(still, leaning, 1e-4, false);
  const double rate = glm::distance(still.rate, leaning.rate);
  CHECK(rate * gentle + 100.0 * gentle * gentle < 1e-4);
  CHECK(gentle > 0.25 * 1e-4 / rate);
  HeightChange folding = leaning;
  folding.bend_per_m = 1e5;
  CHECK(overtaking_margin(still, folding, 1e-4, false) < 0.5 * gentle);
  CHECK(overtaking_margin(still, leaning, 0.0, false) == 0.0);
  // Against a fixed height the rival's own change counts.
  CHECK(overtaking_margin(still, still, 1e-4, true) < overtaking_margin(still, still, 1e-4, false));
}

TEST_CASE("on a patch that is its own offset's centre nothing is told but the normal") {
  const SurfaceSample s = [] {
    SurfaceSample flat;
    flat.point = Vec3(0.0);
    flat.point_u = Vec3(1e-3, 0.0, 0.0);
    flat.point_v = Vec3(0.0, 1e-3, 0.0);
    flat.normal = Vec3(0.0, 0.0, 1.0);
    flat.normal_u = Vec3(-0.05, 0.0, 0.0);  // 1 + h k = 0 at 20 mm
    flat.normal_v = Vec3(0.0);
    return flat;
  }();
  const HeightChange change = height_change_on_face(s, 0.020);
  CHECK(change.rate == s.normal);
  CHECK(std::isfinite(change.bend_per_m));
}
