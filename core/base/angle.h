// Angles between vectors.
#pragma once

#include "core/base/units.h"
#include "core/base/vec.h"

#include <cmath>

namespace tangent {

/// Angle between two vectors, deg; exact near 0 and 180, where acos is not.
inline double angle_between_deg(const Vec3& a, const Vec3& b) {
  const Vec3 x = glm::cross(a, b);
  return std::atan2(std::sqrt(glm::dot(x, x)), glm::dot(a, b)) / kDegree;
}

}  // namespace tangent
