// What a fade and a ramp do with the force that was rendered last.
#pragma once

#include "core/preset/preset.h"

#include <algorithm>
#include <cmath>

namespace tangent {

/// The last force as a plane that stays where it was: what it pushes with after the finger has moved.
inline Vec3 left_of_last(const Vec3& last, const Vec3& moved, double stiffness) {
  const double length = std::sqrt(glm::dot(last, last));
  if (length == 0.0) return Vec3(0.0);
  const Vec3 normal = last / length;
  return std::max(0.0, length - stiffness * glm::dot(normal, moved)) * normal;
}

/// The limit may have been lowered, and counts at once.
inline void limit_force(const Preset& preset, Vec3& force) {
  const double length = std::sqrt(glm::dot(force, force));
  if (length > preset.force.limit_n) force *= preset.force.limit_n / length;
}

}  // namespace tangent
