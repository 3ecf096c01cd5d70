#include "core/finger/facing_normal.h"
#include "core/finger/plane_contact.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

// On the flank of a capsule Newton's steps alone run from end to end, and leave errors of its half length.
TEST_CASE(
    "the finger touches a plane turned to face it at the given point, wherever that is in, on or off the finger") {
  Random random(3);
  for (const FingerShape shape : kFingerShapes) {
    const Finger finger = finger_of(shape);
    double worst = 0.0;
    for (int i = 0; i < rounds(30'000); ++i) {
      const FingerPose pose{random.in_cube(0.05), random.orientation()};
      const double within = i % 3 == 0 ? 0.01 : i % 3 == 1 ? 0.03 : 0.2;
      const Vec3 point = pose.position + random.in_cube(within);
      for (const FacingSide side : {FacingSide::front, FacingSide::back}) {
        const Vec3 normal = facing_normal(finger, pose, point, random.direction(), side);
        worst = std::max(
            {worst, contact_on_plane(finger, pose, point, normal).error_m, std::abs(glm::length(normal) - 1.0)});
      }
    }
    CAPTURE(static_cast<int>(shape));
    CHECK(worst < 1e-14);
  }
}

TEST_CASE("facing from the front shows the finger's nearest point, from the back its furthest") {
  Random random(4);
  for (const FingerShape shape : kFingerShapes) {
    const Finger finger = finger_of(shape);
    for (int i = 0; i < rounds(2000); ++i) {
      const FingerPose pose{random.in_cube(0.05), random.orientation()};
      const Vec3 off = (finger.reach_m() + random.in(1e-4, 0.1)) * random.direction();
      const Vec3 point = pose.position + off;
      const Vec3 front = facing_normal(finger, pose, point, random.direction());
      const Vec3 back = facing_normal(finger, pose, point, random.direction(), FacingSide::back);
      const double gap = -contact_on_plane(finger, pose, point, front).penetration_m;
      const double depth = contact_on_plane(finger, pose, point, back).penetration_m;
      CHECK(gap > 0.0);
      CHECK(glm::dot(pose.position - point, back) < 0.0);
      for (int k = 0; k < 20;
           ++k) {  // no tangent plane of the finger is further off or deeper under the point, near either normal
        const Vec3 near_front = unit(front + 0.05 * random.direction()),
                   near_back = unit(back + 0.05 * random.direction());
        CHECK(-contact_on_plane(finger, pose, point, near_front).penetration_m <= gap + 1e-15);
        CHECK(contact_on_plane(finger, pose, point, near_back).penetration_m <= depth + 1e-15);
      }
    }
  }
}

// Where the searches for turns and normals begin: between the axis' ends most of what is missing is the lean.
TEST_CASE("towards the nearest place of a capsule's axis is all but the direction that faces the capsule") {
  Random random(5);
  const Finger finger = finger_of(FingerShape::capsule);
  double worst = 0.0, worst_unleaned = 0.0;
  int beside = 0;
  for (int i = 0; i < rounds(2000); ++i) {
    const FingerPose pose{random.in_cube(0.05), random.orientation()};
    const Vec3 half = finger.half_length_m * section_of(pose.orientation).distal;
    const Vec3 d = (finger.reach_m() + random.in(1e-3, 0.02)) * random.direction();
    const double along = -glm::dot(d, half) / glm::dot(half, half);
    if (std::abs(along) > 0.9) continue;
    ++beside;
    const Vec3 faces = facing_normal(finger, pose, pose.position - d, random.direction());
    worst = std::max(worst, glm::distance(unit(towards_axis(d, half, along)), faces));
    worst_unleaned = std::max(worst_unleaned, glm::distance(unit(d + along * half), faces));
  }
  CHECK(beside > rounds(2000) / 4);
  CHECK(worst < 6e-3);
  CHECK(worst_unleaned > 3.0 * worst);
  const Vec3 d(0.0, 0.0, 0.01);
  CHECK(towards_axis(d, Vec3(0.0), 0.5) == d);
  CHECK(towards_axis(d, Vec3(0.01, 0.0, 0.0), std::numeric_limits<double>::quiet_NaN()) == d);
  CHECK(towards_axis(d, Vec3(0.01, 0.0, 0.0), 7.0) == towards_axis(d, Vec3(0.01, 0.0, 0.0), 1.0));
}

TEST_CASE("a point at the finger's centre is faced by the given direction") {
  const Finger finger = finger_of(FingerShape::sphere);
  CHECK(facing_normal(finger, FingerPose{}, Vec3(0.0), Vec3(0, 1, 0)) == Vec3(0, 1, 0));
}
