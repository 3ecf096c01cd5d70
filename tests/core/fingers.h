// Fingers of every shape for the tests of the contact.
#pragma once

#include "core/finger/finger.h"

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

}  // namespace tangent::test
