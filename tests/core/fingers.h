// Fingers of every shape for the tests of the contact.
#pragma once

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

}  // namespace tangent::test
