// The finger as a ball rolled over its core, and the bounds that proofs rest on.
#include "core/finger/finger_core.h"
#include "core/contact/contact_rank.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

Finger any_finger(FingerShape shape, Random& random) {
  Finger finger;
  finger.shape = shape;
  finger.radius_m = random.in(0.001, 0.020);
  finger.half_length_m = random.in(0.001, 0.020);
  finger.semi_axes_m = {random.in(0.005, 0.020), random.in(0.005, 0.020), random.in(0.005, 0.020)};
  return finger;
}

/// Of any length, across n.
Vec3 across(const Vec3& n, Random& random) {
  const Vec3 v = random.direction();
  return unit(v - glm::dot(v, n) * n);
}

}  // namespace

TEST_CASE("a finger is the ball about its core's points") {
  Random random(61);
  for (const FingerShape shape : kFingerShapes) {
    CAPTURE(static_cast<int>(shape));
    for (int i = 0; i < 1000; ++i) {
      const Finger finger = any_finger(shape, random);
      const FingerPose pose{random.in_cube(1.0), random.orientation()};
      const FingerCore core(finger, pose);
      const Vec3 n = random.direction();
      CHECK(glm::distance(support_point(finger, pose, n), core.support(n).point - core.ball_m() * n) < 1e-15);
      const Vec3 t = across(n, random);
      const Mat3 whole = support_with_derivative(finger, pose, n).by_normal;
      CHECK(glm::distance(whole * t, core.derivative(core.support(n), t) - core.ball_m() * t) <=
            1e-12 * core.flattest_m());
      CHECK(std::abs(core.derivative_length(core.support(n), core.scaled(t)) -
                     glm::length(core.derivative(core.support(n), t))) <= 1e-12 * core.flattest_m());
      CHECK(-glm::dot(t, whole * t) <= core.flattest_m() * (1.0 + 1e-9));
      CHECK(-glm::dot(t, whole * t) >= core.sharpest_m() * (1.0 - 1e-9));
      CHECK(-glm::dot(t, whole * t) <= (core.ball_m() + core.largest_radius(core.support(n).length)) * (1.0 + 1e-9));
    }
  }
}

TEST_CASE("beside a normal the core's points are linear in it, but for the bend, and that bound is no tale") {
  Random random(62);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    int over = 0;
    double share = 0.0;
    for (int i = 0; i < rounds(20000); ++i) {
      const Finger finger = any_finger(shape, random);
      const FingerPose pose{Vec3(0.0), random.orientation()};
      const FingerCore core(finger, pose);
      const Vec3 n = random.direction(), t = random.direction();
      const double tangent = std::pow(10.0, random.in(-4.0, 0.0));
      const Vec3 tau = random.in(0.0, 1.0) * tangent * across(n, random);
      const CoreSupport here = core.support(n);
      over += core.half_width(tau) > core.widest_step(here, tangent) * (1.0 + 1e-12);
      const double bound = core.half_width(t) * core.bend(here, core.half_width(tau));
      const Vec3 rest = core.support(n + tau).point - here.point - core.derivative(here, tau);
      const double off = std::abs(glm::dot(rest, t));
      over += off > bound * (1.0 + 1e-9) + 1e-15;
      if (bound > 0.0 && off > 1e-12) share = std::max(share, off / bound);
    }
    CHECK(over == 0);
    CHECK(share > 0.5);
  }
}

TEST_CASE("while the finger goes and turns, no core point slides further across its normal than its way allows") {
  Random random(63);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    double most_slide = 0.0, most_depth = 0.0, most_way = 0.0;
    for (int i = 0; i < rounds(20000); ++i) {
      const Finger finger = any_finger(shape, random);
      const FingerPose from{random.in_cube(0.1), random.orientation()};
      const FingerCore before(finger, from);
      const double way = std::pow(10.0, random.in(-6.0, -2.0)), turned = random.in(0.0, 1.0) * way;
      const FingerPose to{from.position + (way - turned) * random.direction(),
                          glm::angleAxis(turned / before.reach_m(), random.direction()) * from.orientation};
      const FingerCore after(finger, to);
      const Vec3 n = random.direction(), t = across(n, random);
      const CoreSupport a = before.support(n), b = after.support(n);
      const double slid = std::abs(glm::dot(b.point - a.point, t));
      most_slide = std::max(most_slide, slid / before.slide_m(before.half_width(t), a.length, way));
      most_depth = std::max(most_depth, std::abs(glm::dot(b.point - a.point, n)) / way);
      const double room = std::pow(10.0, random.in(-6.0, -2.0)),
                   within = before.way_within(before.half_width(t), a.length, room);
      most_way = std::max(most_way, before.slide_m(before.half_width(t), a.length, within) / room);
    }
    CHECK(most_slide <= 1.0 + 1e-9);
    CHECK(most_slide > 0.4);
    CHECK(most_depth <= 1.0 + 1e-9);
    CHECK(most_depth > 0.5);
    CHECK(most_way <= 1.0 + 1e-9);
  }
}

TEST_CASE("a contact ranks no lower, and lies no further off, than its normal and its rank allow") {
  Random random(65);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    double nearest_rank = 1.0, farthest = 0.0;
    for (int i = 0; i < rounds(20000); ++i) {
      const Finger finger = any_finger(shape, random);
      const FingerPose pose{random.in_cube(0.1), random.orientation()};
      const FingerCore core(finger, pose);
      const Vec3 n = random.direction();
      const double depth = random.in(-0.01, 2.0 * finger.reach_m());
      const Vec3 place = support_point(finger, pose, n) + depth * n;
      const double rank = contact_rank(finger, contact_on_plane(finger, pose, place, n));
      const double half = random.in(0.0, 2.0);
      const NormalCone cone{unit(n + std::tan(std::min(half, 1.5)) * random.in(0.0, 1.0) * across(n, random)),
                            std::cos(std::min(half, 1.5) * (1.0 + 1e-9))};
      CHECK(core.least_rank(cone) <= rank + 1e-15);
      CHECK(core.least_rank({n, 1.0}) >= core.least_rank(cone) - 1e-15);
      const double most = core.farthest_m(rank), is = glm::distance(place, pose.position);
      CHECK(is <= most + 1e-15);
      CHECK(core.farthest_m(rank + 1e-3) >= most - 1e-15);
      // Neither is idle: some contacts come close.
      if (rank < finger.reach_m()) nearest_rank = std::min(nearest_rank, rank - core.least_rank({n, 1.0}));
      farthest = std::max(farthest, is / most);
      const SurfaceBounds part(place, Vec3(0.0), cone);
      const double behind = behind_m(core, part);
      if (!(behind > 1e-9)) continue;
      CHECK(is_behind(core, part, behind - 1e-9));
      CHECK_FALSE(is_behind(core, part, behind + 1e-9));
      CHECK(rank >= finger.reach_m() + behind - 1e-12);
    }
    CHECK(nearest_rank < 1e-4);
    CHECK(farthest > 0.99);
  }
}

TEST_CASE("a part of the surface that is touched is never said to be out of touch, nor one that will be") {
  Random random(64);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    int missed = 0, left_out = 0, margins = 0, told_more = 0, at_a_glance = 0, beside = 0, behind = 0;
    for (int i = 0; i < rounds(20000); ++i) {
      const Finger finger = any_finger(shape, random);
      FingerPose pose{Vec3(0.0), random.orientation()};
      const Vec3 n = random.direction();
      // A part that holds the point 0 with normal n, which the finger touches so deep.
      const double depth = random.in(-0.01, 0.01), half_angle = std::pow(10.0, random.in(-3.0, -0.1));
      pose.position = -depth * n - support_point(finger, pose, n);
      const Vec3 half = std::pow(10.0, random.in(-5.0, -2.0)) * Vec3(1.0);
      const Vec3 middle = random.in(0.0, 1.0) * half * random.direction();
      const NormalCone normals{unit(n + random.in(0.0, 0.95) * std::tan(half_angle) * across(n, random)),
                               std::cos(half_angle)};
      const SurfaceBounds part(middle, half, normals);
      const FingerCore core(finger, pose);
      const double lambda = core.ball_m() - depth;
      missed += !can_touch(core, part, lambda + 1e-12, 0.0) + (touch_margin(core, part) > 0.0);
      left_out += !can_touch(core, part, lambda - 0.020, 0.0);
      // Seen from elsewhere, as far as it is.
      const double way = std::pow(10.0, random.in(-5.0, -2.0)), turned = random.in(0.0, 1.0) * way;
      const FingerPose other{pose.position + (way - turned) * random.direction(),
                             glm::angleAxis(turned / core.reach_m(), random.direction()) * pose.orientation};
      const FingerCore there(finger, other);
      const double margin = touch_margin(there, part);
      missed += margin > way * (1.0 + 1e-9) + 1e-12;
      missed += !can_touch(there, part, lambda + way + 1e-12, way) + !can_touch_at_a_glance(there, part, way);
      missed += is_beside(there, part, way);
      beside += is_beside(there, part, 0.0);
      const double in_front = glm::dot(other.position, n);  // of the plane through 0
      missed += in_front >= 0.0 && is_behind(there, part, 0.0);
      missed += glm::dot(pose.position, n) >= 0.0 && is_behind(there, part, way);
      behind += is_behind(there, part, way);
      told_more += can_touch(there, part, 1.0, 0.0) && !can_touch_at_a_glance(there, part, 0.0);
      at_a_glance += !can_touch_at_a_glance(there, part, 0.0);
      margins += margin > 0.1 * way;
    }
    CHECK(missed == 0);
    CHECK(told_more == 0);
    CHECK(at_a_glance > rounds(20000) / 100);
    CHECK(beside > rounds(20000) / 1000);
    CHECK(behind > rounds(20000) / 500);
    CHECK(left_out > rounds(20000) / 10);
    CHECK(margins > rounds(20000) / 200);
  }
}

TEST_CASE(
    "a place outside the finger is at least as far off as is said, and contacts there rank no lower than is said") {
  Random random(65);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    CAPTURE(static_cast<int>(shape));
    int wrong = 0, below = 0, beyond = 0, ranked = 0;
    double said = 0.0;
    for (int i = 0; i < rounds(20000); ++i) {
      const Finger finger = any_finger(shape, random);
      const FingerPose pose{random.in_cube(0.1), random.orientation()};
      const FingerCore core(finger, pose);
      // On the normal of a plane that the finger touches: below it, or above, where it leaves the finger again.
      const Vec3 n = random.direction();
      const double depth = random.in(-1.0, 3.0) * core.reach_m();
      const Vec3 place = support_point(finger, pose, n) + depth * n;
      const Vec3 half = random.in(0.0, 0.2) * core.reach_m() * Vec3(1.0), off = random.in(-1.0, 1.0) * half;
      const double apart = core.apart_m(place, Vec3(0.0));
      const Vec3 beside = glm::max(glm::abs(place + off - pose.position) - half, Vec3(0.0));
      wrong += core.apart_m(place + off, half) > glm::length(beside) - core.inner_m() + 1e-12;
      if (depth < 0.0) {
        ++below;
        wrong += std::max(apart, core.apart_m(place + off, half)) > -depth + 1e-12;
        said += apart / -depth;
      }
      if (!(apart > 0.0) || !std::isfinite(core.rank_outside(apart))) continue;
      ++ranked;
      beyond += depth > 0.0;
      const PlaneContact contact = contact_on_plane(finger, pose, place, n);
      const double rank = contact_rank(finger, contact);
      wrong += rank < core.rank_outside(apart) - 1e-12 || core.outside_at(rank, 0.0) < apart - 1e-12;
    }
    CHECK(wrong == 0);
    CHECK(said > 0.8 * below);
    CHECK(ranked > rounds(20000) / 5);
    CHECK(beyond > rounds(20000) / 20);
  }
}
