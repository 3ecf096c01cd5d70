// Fingers of every shape for the tests of the contact.
#pragma once

#include "core/contact/prove/clearance_check.h"
#include "core/finger/finger.h"
#include "tests/core/scenes.h"

namespace tangent::test {

inline constexpr FingerShape kFingerShapes[] = {FingerShape::point, FingerShape::sphere, FingerShape::ellipsoid,
                                                FingerShape::capsule};

/// Of a fingertip's size, the ellipsoid of three different axes.
inline Finger finger_of(FingerShape shape) {
  Finger finger;
  finger.shape = shape;
  finger.radius_m = 0.008;
  finger.semi_axes_m = {0.015, 0.009, 0.006};
  finger.half_length_m = 0.010;
  return finger;
}

/// The finger rests on a plane through that point, so deep in it, turned anyhow.
inline FingerPose resting_on(const Finger& finger, const Vec3& point, const Vec3& normal, double depth_m,
                             Random& random) {
  FingerPose pose{Vec3(0.0), random.orientation()};
  pose.position = point - depth_m * normal - support_point(finger, pose, normal);
  return pose;
}

/// A pose from which the finger comes to that one, and how far that is.
inline FingerPose before(const Finger& finger, const FingerPose& there, double way_m, Random& random, double& gone_m) {
  const double turns = is_round(finger) ? 0.0 : random.in(0.0, 1.0);
  FingerPose pose = there;
  pose.position -= (1.0 - turns) * way_m * random.direction();
  pose.orientation =
      glm::normalize(glm::angleAxis(turns * way_m / finger.reach_m(), random.direction()) * there.orientation);
  gone_m = glm::distance(pose.position, there.position) + turned_m(finger, pose.orientation, there.orientation);
  return pose;
}

}  // namespace tangent::test
