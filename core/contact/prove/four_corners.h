// The corners of a face and its sides side by side in floats (FaceLanes): what proofs ask of all three at once.
#pragma once

#include "core/contact/face_outline.h"

#include <algorithm>
#include <optional>

namespace tangent {

/// Ratio to the coordinates, and to a margin: far above what a dozen operations in float are rounded by.
inline constexpr double kLaneRoom = 4e-6;

/// Each corner's, or side's, next one, and the one before.
inline Four next(const Four& x) { return __builtin_shufflevector(x, x, 1, 2, 0, 1); }
inline FourVec3 next(const FourVec3& a) { return {next(a[0]), next(a[1]), next(a[2])}; }
inline Four before(const Four& x) { return __builtin_shufflevector(x, x, 2, 0, 1, 2); }
inline FourVec3 before(const FourVec3& a) { return {before(a[0]), before(a[1]), before(a[2])}; }

/// The sum of the three, four times.
inline Four sum(const Four& x) {
  return __builtin_shufflevector(x, x, 0, 0, 0, 0) + __builtin_shufflevector(x, x, 1, 1, 1, 1) +
         __builtin_shufflevector(x, x, 2, 2, 2, 2);
}
inline FourVec3 sum(const FourVec3& a) { return {sum(a[0]), sum(a[1]), sum(a[2])}; }
inline float least(const Four& x) { return std::min({x[0], x[1], x[2]}); }
inline float greatest(const Four& x) { return std::max({x[0], x[1], x[2]}); }
/// Whether all three are.
inline bool all(const FourMask& mask) { return (bits_of(mask) & 7u) == 7u; }

inline FourVec3 all_four(const Vec3& v) { return {all_four(v.x), all_four(v.y), all_four(v.z)}; }
inline FourVec3 scaled(const FourVec3& a, const Four& by) { return {a[0] * by, a[1] * by, a[2] * by}; }
inline FourVec3 operator+(const FourVec3& a, const FourVec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline FourVec3 operator-(const FourVec3& a, const FourVec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Whether floats hold all digits of a squared length, m^2.
inline bool is_measured(float length2) { return length2 > 1e-24f && length2 < 1e24f; }

/// The direction of what is the same four times, if it has one.
inline std::optional<FourVec3> direction_of(const FourVec3& v) {
  const Four length2 = dot(v, v);
  if (!is_measured(length2[0])) return std::nullopt;
  return scaled(v, 1.0f / sqrt(length2));
}

/// The misses (c - P) x N of a flat face along a direction, by the normals and the direction's cross products with
/// them: a cubic for one point c, whose least Bezier coefficient but for those of the corners is asked for.
struct MissesAlong {
  FourVec3 q, middle;  ///< N x direction, at the corners and for the normals over the sides

  MissesAlong(const FaceLanes& face, const FourVec3& direction)
      : q(cross(face.normals, direction)), middle(cross(face.middle_normals, direction)) {}

  /// `away`: from the corners to the point. Three times the least.
  Four least3(const FourVec3& away) const {
    const FourVec3 next_away = next(away);
    const Four near_start = dot(next_away, q) + 2.0f * dot(away, middle);
    const Four near_end = dot(away, next(q)) + 2.0f * dot(next_away, middle);
    return min(min(near_start, near_end), sum(dot(away, next(middle))));
  }
};

}  // namespace tangent
