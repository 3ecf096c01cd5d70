// Vector types of the whole program: double precision, GLM. Metres, right-handed world frame.
#pragma once

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace tangent {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Mat3 = glm::dmat3;  // column-major, as GLM
using Quat = glm::dquat;  // (w, x, y, z)

/// Unit vector along `v`, dividing by the correctly rounded length (glm::normalize multiplies by a
/// reciprocal square root, which costs another rounding). Precondition: v is finite and not zero.
inline Vec3 unit(const Vec3& v) { return v / std::sqrt(glm::dot(v, v)); }

/// Unit vector along v, or `otherwise` where v vanishes: shorter than 1e-12, for sums of unit vectors.
inline Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length2 = glm::dot(v, v);
  return length2 > 1e-24 ? v / std::sqrt(length2) : otherwise;
}

/// A vector of the plane, in space.
inline Vec3 lifted(const Vec2& v) { return {v.x, v.y, 0.0}; }

inline bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Axis-aligned box, metres. Empty (min > max) when default-constructed.
struct Box {
  Vec3 min{1e300, 1e300, 1e300};
  Vec3 max{-1e300, -1e300, -1e300};

  void include(const Vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  bool empty() const { return min.x > max.x; }
  Vec3 centre() const { return 0.5 * (min + max); }
  Vec3 size() const { return empty() ? Vec3(0.0) : max - min; }
};

}  // namespace tangent
