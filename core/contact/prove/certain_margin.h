// What of a proof's margin is left when rounding is taken off: a contact exactly on the border of two triangles, or on
// a corner, must not be excluded by each of them.
#pragma once

#include "core/base/tolerances.h"
#include "core/base/vec.h"

#include <algorithm>

namespace tangent {

/// By how much a margin may be wrong, m, that is known from coordinates as large as those of the finger's centre and of
/// a place on the triangle, both local.
inline double rounding_of_margin(const Vec3& centre, const Vec3& place) {
  const Vec3 sum = glm::abs(centre) + glm::abs(place);
  return kProofRounding * (sum.x + sum.y + sum.z);
}

/// 0 where nothing is certain.
inline double certain_margin(double margin_m, double rounding_m) { return std::max(0.0, margin_m - rounding_m); }

/// Of the margin that would be enough: where a first look tells that much, no more is looked for. Larger: dearer looks;
/// smaller: more of them.
inline constexpr double kAtOnceShare = 0.25;

}  // namespace tangent
