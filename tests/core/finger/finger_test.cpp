#include "core/finger/finger.h"
#include "core/finger/plane_contact.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kPi = std::numbers::pi;

/// A point on the surface of the finger, in the world.
Vec3 surface_point(const Finger& finger, const FingerPose& pose, Random& random) {
  const Vec3 d = random.direction();
  switch (finger.shape) {
    case FingerShape::sphere:
      return pose.position + finger.radius_m * d;
    case FingerShape::ellipsoid:
      return pose.position + pose.orientation * (finger.semi_axes_m * d);
    case FingerShape::capsule: {
      const double along = random.in(-finger.half_length_m, finger.half_length_m);
      return pose.position + pose.orientation * Vec3(along, 0.0, 0.0) + finger.radius_m * d;
    }
    case FingerShape::point:
      break;
  }
  return pose.position;
}

FingerPose random_pose(Random& random) { return {random.in_cube(0.05), random.orientation()}; }

Vec3 perpendicular(const Vec3& n) { return unit(glm::cross(n, std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0))); }

FingerPose level() { return {}; }
/// The contact's normal for a contact direction (x, z) in the finger frame.
Vec3 normal_for(double x, double z) { return -unit(Vec3(x, 0.0, z)); }

}  // namespace

TEST_CASE("no point of the finger lies further along -N than its support point") {
  Random random(1);
  for (const FingerShape shape : kFingerShapes) {
    const Finger finger = finger_of(shape);
    for (int i = 0; i < 50; ++i) {
      const FingerPose pose = random_pose(random);
      const Vec3 n = random.direction();
      const double support = glm::dot(support_point(finger, pose, n), -n);
      double furthest = -1.0;
      for (int k = 0; k < 400; ++k) furthest = std::max(furthest, glm::dot(surface_point(finger, pose, random), -n));
      CHECK(support >= furthest - 1e-15);
      CHECK(support <= glm::dot(pose.position, -n) + finger.reach_m() + 1e-15);
    }
  }
}

TEST_CASE("the support point of a sphere and an ellipsoid lies on them - that of a capsule within its spindle's 1 %") {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const FingerPose pose = random_pose(random);
    const Vec3 n = random.direction();
    const auto local = [&](const Finger& f) {
      return glm::conjugate(pose.orientation) * (support_point(f, pose, n) - pose.position);
    };
    const Finger sphere = finger_of(FingerShape::sphere);
    CHECK(glm::length(local(sphere)) == approx(sphere.radius_m).epsilon(1e-14));
    const Finger ellipsoid = finger_of(FingerShape::ellipsoid);
    CHECK(glm::length(local(ellipsoid) / ellipsoid.semi_axes_m) == approx(1.0).epsilon(1e-14));
    const Finger capsule = finger_of(FingerShape::capsule);
    const Vec3 p = local(capsule);
    const double x = std::clamp(p.x, -capsule.half_length_m, capsule.half_length_m);
    const double distance = glm::length(p - Vec3(x, 0.0, 0.0));
    CHECK(distance >= capsule.radius_m * (1.0 - 1e-14));
    CHECK(distance <= capsule.radius_m + 0.01 * capsule.half_length_m);
  }
}

TEST_CASE("dp/dN is the derivative of the support point") {
  Random random(3);
  constexpr double kTurn = 1e-6;
  for (const FingerShape shape : kFingerShapes) {
    const Finger finger = finger_of(shape);
    for (int i = 0; i < 200; ++i) {
      const FingerPose pose = random_pose(random);
      const Vec3 n = random.direction();
      const Mat3 by_normal = support_with_derivative(finger, pose, n).by_normal;
      const Vec3 t = perpendicular(n), s = glm::cross(n, t);
      const double angle = random.in(0.0, 2.0 * kPi);
      const Vec3 d = std::cos(angle) * t + std::sin(angle) * s;
      const Vec3 plus = support_point(finger, pose, std::cos(kTurn) * n + std::sin(kTurn) * d);
      const Vec3 minus = support_point(finger, pose, std::cos(kTurn) * n - std::sin(kTurn) * d);
      const Vec3 difference = (plus - minus) / (2.0 * kTurn);
      // Near the capsule's waist the spindle's tip radius is 1/kSpindle of its length: differences of third order show.
      CHECK(glm::length(by_normal * d - difference) <=
            1e-7 * std::max(finger.reach_m(), glm::length(difference)) + 1e-10);
    }
  }
}

TEST_CASE("dp/dN is symmetric and turns no normal towards itself") {
  // The Hessian of the support function: symmetric, and its image lies in the tangent plane.
  Random random(4);
  for (const FingerShape shape : {FingerShape::ellipsoid, FingerShape::capsule}) {
    const Finger finger = finger_of(shape);
    for (int i = 0; i < 100; ++i) {
      const FingerPose pose = random_pose(random);
      const Vec3 n = random.direction(), t = perpendicular(n), s = glm::cross(n, t);
      const Mat3 m = support_with_derivative(finger, pose, n).by_normal;
      const double scale = std::abs(glm::dot(t, m * t)) + std::abs(glm::dot(s, m * s));
      CHECK(std::abs(glm::dot(t, m * s) - glm::dot(s, m * t)) <= 1e-12 * scale);
      CHECK(std::abs(glm::dot(n, m * t)) <= 1e-12 * scale);
      CHECK(glm::dot(t, m * t) < 0.0);
      CHECK(glm::dot(s, m * s) < 0.0);
    }
  }
}

TEST_CASE("an ellipsoid with equal axes and a capsule without length are spheres") {
  Random random(5);
  Finger sphere = finger_of(FingerShape::sphere), ball = finger_of(FingerShape::ellipsoid),
         capsule = finger_of(FingerShape::capsule);
  ball.semi_axes_m = Vec3(sphere.radius_m);
  capsule.half_length_m = 0.0;
  for (int i = 0; i < 100; ++i) {
    const FingerPose pose = random_pose(random);
    const Vec3 n = random.direction();
    const Vec3 expected = support_point(sphere, pose, n);
    CHECK(glm::length(support_point(ball, pose, n) - expected) <= 1e-16);
    CHECK(glm::length(support_point(capsule, pose, n) - expected) <= 1e-16);
    const double arc = contact_arc_m(sphere, pose, n);
    CHECK(contact_arc_m(ball, pose, n) == approx(arc).epsilon(1e-13));
    CHECK(contact_arc_m(capsule, pose, n) == approx(arc).epsilon(1e-13));
  }
}

TEST_CASE("the contact location of a sphere is R atan2(m.x, -m.z)") {
  const Finger finger = finger_of(FingerShape::sphere);
  for (double angle = -3.1; angle <= 3.1; angle += 0.1)
    CHECK(contact_arc_m(finger, level(), normal_for(std::sin(angle), -std::cos(angle))) ==
          approx(finger.radius_m * angle).epsilon(1e-13));
}

TEST_CASE("the contact location of a point finger is zero") {
  Random random(6);
  const Finger finger = finger_of(FingerShape::point);
  for (int i = 0; i < 20; ++i) CHECK(contact_arc_m(finger, random_pose(random), random.direction()) == 0.0);
}

namespace {

/// Walks the contact from the pad's middle distally up to `limit` rad; true if the location grows all the way and is
/// odd.
bool grows_and_is_odd(const Finger& finger, double limit) {
  double last = 0.0;
  for (double angle = 0.01; angle < limit; angle += 0.01) {
    const double arc = contact_arc_m(finger, level(), normal_for(std::sin(angle), -std::cos(angle)));
    const double mirrored = contact_arc_m(finger, level(), normal_for(-std::sin(angle), -std::cos(angle)));
    if (!(arc > last) || std::abs(mirrored + arc) > 1e-12) return false;
    last = arc;
  }
  return contact_arc_m(finger, level(), normal_for(0.0, -1.0)) == 0.0;
}

}  // namespace

TEST_CASE("the contact location is positive distally, odd, and grows with the angle up to the fingertip") {
  for (const FingerShape shape : {FingerShape::sphere, FingerShape::ellipsoid, FingerShape::capsule})
    CHECK(grows_and_is_odd(finger_of(shape), 0.5 * kPi));
}

TEST_CASE("past the fingertip the contact location goes on growing along the nail side: sphere, ellipsoid") {
  for (const FingerShape shape : {FingerShape::sphere, FingerShape::ellipsoid})
    CHECK(grows_and_is_odd(finger_of(shape), 3.14));
}

// Fails: the straight part shrinks to nothing past the fingertip, where the contact runs back along the nail side.
TEST_CASE("past the fingertip the contact location goes on growing along the nail side: capsule") {
  const Finger finger = finger_of(FingerShape::capsule);
  CHECK(grows_and_is_odd(finger, 3.1));
  CHECK(contact_arc_m(finger, level(), normal_for(1e-9, 1.0)) ==
        approx(2.0 * finger.half_length_m + kPi * finger.radius_m).epsilon(1e-3));
}

TEST_CASE("the contact location of an ellipsoid is the arc of its section, integrated numerically") {
  for (const Vec3& axes : {Vec3(0.015, 0.009, 0.006), Vec3(0.006, 0.009, 0.015), Vec3(0.01, 0.02, 0.01)}) {
    Finger finger = finger_of(FingerShape::ellipsoid);
    finger.semi_axes_m = axes;
    for (double angle = -3.0; angle <= 3.0; angle += 0.25) {
      // Parameter of the point (a sin t, -c cos t) whose outward normal has this angle.
      const double end = std::atan2(axes.x * std::sin(angle), axes.z * std::cos(angle));
      constexpr int kSteps = 2000;  // Simpson
      double sum = 0.0;
      for (int i = 0; i <= kSteps; ++i) {
        const double t = end * i / kSteps;
        const double speed = std::hypot(axes.x * std::cos(t), axes.z * std::sin(t));
        sum += speed * (i == 0 || i == kSteps ? 1.0 : i % 2 ? 4.0 : 2.0);
      }
      const double arc = sum * end / kSteps / 3.0;
      CHECK(contact_arc_m(finger, level(), normal_for(std::sin(angle), -std::cos(angle))) ==
            approx(arc).epsilon(1e-10).scale(1e-2));
    }
  }
}

TEST_CASE("the contact location of a capsule is its straight part and the arc of its end") {
  const Finger finger = finger_of(FingerShape::capsule);
  // Clear of the pad's middle, where the spindle's 1 % rounds the step, the contact is on the distal hemisphere.
  for (double angle = 0.2; angle < 1.6; angle += 0.1) {
    const double arc = contact_arc_m(finger, level(), normal_for(std::sin(angle), -std::cos(angle)));
    const double exact = finger.half_length_m + finger.radius_m * angle;
    CHECK(std::abs(arc - exact) <= 0.002 * finger.half_length_m);
  }
  CHECK(contact_arc_m(finger, level(), normal_for(1.0, 0.0)) ==
        approx(finger.half_length_m + finger.radius_m * 0.5 * kPi).epsilon(1e-4));
}

TEST_CASE("the contact location is continuous through the fingertip and through the fingerpad") {
  for (const FingerShape shape : {FingerShape::sphere, FingerShape::ellipsoid, FingerShape::capsule}) {
    const Finger finger = finger_of(shape);
    const auto arc = [&](double angle) {
      return contact_arc_m(finger, level(), normal_for(std::sin(angle), -std::cos(angle)));
    };
    for (const double at : {0.0, 0.5 * kPi, -0.5 * kPi, 2.5, -2.5})
      CHECK(std::abs(arc(at + 1e-9) - arc(at - 1e-9)) <= 1e-8 * (shape == FingerShape::capsule ? 1.0 : 0.02));
  }
}

TEST_CASE("turning finger and normal together changes no contact location") {
  Random random(7);
  for (const FingerShape shape : {FingerShape::sphere, FingerShape::ellipsoid, FingerShape::capsule}) {
    const Finger finger = finger_of(shape);
    for (int i = 0; i < 100; ++i) {
      const FingerPose pose = random_pose(random);
      const Vec3 n = random.direction();
      CHECK(contact_arc_m(finger, pose, pose.orientation * n) ==
            approx(contact_arc_m(finger, level(), n)).epsilon(1e-9));
    }
  }
}

TEST_CASE("height and penetration of a plane contact measure the support point and the centre") {
  Random random(8);
  for (const FingerShape shape : kFingerShapes) {
    const Finger finger = finger_of(shape);
    for (int i = 0; i < 50; ++i) {
      const FingerPose pose = random_pose(random);
      const Vec3 n = random.direction(), s = random.in_cube(0.05);
      const PlaneContact c = contact_on_plane(finger, pose, s, n);
      const Vec3 support = support_point(finger, pose, n);
      CHECK(c.height_m == approx(glm::dot(pose.position - s, n)).epsilon(1e-12));
      CHECK(c.penetration_m == approx(-glm::dot(support - s, n)).epsilon(1e-11));
      CHECK(std::abs(glm::dot(c.travel, n)) <= 1e-16);
      CHECK(glm::length(s + c.travel - c.penetration_m * n - support) <= 1e-16);
      CHECK(c.error_m == approx(glm::length(c.travel)).epsilon(1e-14));
    }
  }
}

TEST_CASE("the offset derivative says how the travel answers a turn of the plane") {
  Random random(9);
  constexpr double kTurn = 1e-6;
  for (const FingerShape shape : kFingerShapes) {
    const Finger finger = finger_of(shape);
    for (int i = 0; i < 50; ++i) {
      const FingerPose pose = random_pose(random);
      const Vec3 n = random.direction(), d = perpendicular(n);
      // S below the support point: the travel vanishes, and d(travel) = -H dN in the plane.
      const double penetration = random.in(-0.005, 0.005);
      const Vec3 s = support_point(finger, pose, n) + penetration * n;
      const Vec3 plus = contact_on_plane(finger, pose, s, std::cos(kTurn) * n + std::sin(kTurn) * d).travel;
      const Vec3 minus = contact_on_plane(finger, pose, s, std::cos(kTurn) * n - std::sin(kTurn) * d).travel;
      const Vec3 difference = (plus - minus) / (2.0 * kTurn);
      const Vec3 expected = -(offset_derivative(finger, pose, n, penetration) * d);
      const Vec3 off = expected - difference;
      CHECK(glm::length(off - glm::dot(off, n) * n) <= 1e-7 * std::max(finger.reach_m(), glm::length(expected)) + 1e-9);
    }
  }
}
