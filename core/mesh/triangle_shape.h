// Measures of one flat triangle that stay right for slivers and at any scale.
#pragma once

#include "core/base/tolerances.h"
#include "core/base/vec.h"

#include <algorithm>
#include <cmath>

namespace tangent {

/// Twice the area along the normal (a, b, c counter-clockwise seen from its tip). The product is taken at the corner
/// opposite the longest side: its rounding is relative to the two short sides, which keeps a sliver's normal.
inline Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double ab2 = glm::dot(ab, ab), bc2 = glm::dot(bc, bc), ca2 = glm::dot(ca, ca);
  if (bc2 >= ab2 && bc2 >= ca2) return glm::cross(ca, ab);
  if (ca2 >= ab2) return glm::cross(ab, bc);
  return glm::cross(bc, ca);
}

/// Square of the longest side, m^2.
inline double longest_side2(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  return std::max({glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
}

/// No area: the smallest height is at most kDegenerateHeight of the longest side, or below what the
/// coordinates can hold (kCoordinateRounding). True for NaN.
inline bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 twice_area = area_vector(a, b, c);
  const double side2 = longest_side2(a, b, c);
  const Vec3 reach = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const double rounding = kCoordinateRounding * std::max({reach.x, reach.y, reach.z});
  // (x + y)^2 <= 2 x^2 + 2 y^2: nearly all triangles are told without a root.
  const double enough = 2.001 * side2 * (kDegenerateHeight * kDegenerateHeight * side2 + rounding * rounding);
  if (glm::dot(twice_area, twice_area) > enough) return false;
  const double side = std::sqrt(side2);
  const double least = side * (kDegenerateHeight * side + rounding);
  return !(glm::dot(twice_area, twice_area) > least * least);
}

/// Not degenerate by far: nor is it after the triangle is moved so that no coordinate is beyond `reach_m`, and then
/// scaled, each corner rounded both times. That takes less than 11 roundings of `reach_m` off its height, which is at
/// least eight times what is_degenerate asks for, four roundings among it.
inline bool is_far_from_degenerate(const Vec3& a, const Vec3& b, const Vec3& c, double reach_m) {
  const Vec3 twice_area = area_vector(a, b, c);
  const double side2 = longest_side2(a, b, c);
  const Vec3 reach = glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c)));
  const double rounding = kCoordinateRounding * std::max({reach.x, reach.y, reach.z, reach_m});
  return glm::dot(twice_area, twice_area) >
         64.0 * 2.001 * side2 * (kDegenerateHeight * kDegenerateHeight * side2 + rounding * rounding);
}

/// Unit normal. Precondition: not degenerate.
inline Vec3 face_normal(const Vec3& a, const Vec3& b, const Vec3& c) { return unit(area_vector(a, b, c)); }

}  // namespace tangent
