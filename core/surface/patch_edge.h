// One edge of a PN triangle: the cubic curve and the quadratic normal of its side, at a fraction of the patch's work.
// Edge k runs from corner k to corner k + 1; the other corner plays no part. Inline: a contact on a curved edge is
// little else.
#pragma once

#include "core/surface/pn_patch.h"

#include <cmath>

namespace tangent {

/// The curve as a polynomial in the fraction f of the edge, from its first corner.
struct EdgeCurve {
  Vec3 origin;                 ///< corner 0 of the patch, m
  std::array<Vec3, 4> powers;  ///< point - origin = powers[0] + f powers[1] + f^2 powers[2] + f^3 powers[3], m
};
/// The normals before they are given unit length, likewise.
struct EdgeNormals {
  std::array<Vec3, 3> powers;
  Vec3 flat;  ///< normal of the flat triangle, where the polynomial vanishes
};
/// The curve's Bezier points, and the Bernstein coefficients of its normals before they are given unit length.
std::array<Vec3, 4> edge_points(const PnPatch& patch, std::uint32_t edge);
std::array<Vec3, 3> edge_normal_coefficients(const PnPatch& patch, std::uint32_t edge);
EdgeCurve edge_curve(const PnPatch& patch, std::uint32_t edge);
EdgeNormals edge_normals(const PnPatch& patch, std::uint32_t edge);
/// The same edge with f counted from its other end.
EdgeNormals reversed(const EdgeNormals& normals);

/// At fraction f of an edge: what `evaluate` of the patch gives there but for rounding.
struct EdgePoint {
  Vec3 point, point_f, point_ff;  ///< m
};
struct EdgeNormal {
  Vec3 normal, normal_f;  ///< unit, and its derivative
  Vec3 unscaled;          ///< along `normal`, before it is divided by its length
};

inline EdgePoint evaluate(const EdgeCurve& curve, double f) {
  const auto& p = curve.powers;
  const Vec3 f3 = f * p[3], bend = p[2] + f3;
  EdgePoint at;
  at.point = curve.origin + (p[0] + f * (p[1] + f * bend));
  at.point_f = p[1] + f * (2.0 * bend + f3);
  at.point_ff = 2.0 * (bend + 2.0 * f3);
  return at;
}

inline EdgeNormal evaluate(const EdgeNormals& edge, double f) {
  const auto& p = edge.powers;
  const Vec3 f2 = f * p[2], slope = p[1] + f2;
  const Vec3 n = p[0] + f * slope, n_f = slope + f2;
  const double length = std::sqrt(glm::dot(n, n)), per_length = 1.0 / length;
  EdgeNormal at;
  at.unscaled = n;
  at.normal = per_length * n;
  at.normal_f = per_length * (n_f - glm::dot(at.normal, n_f) * at.normal);
  if (length < kVanishingNormal) {
    at.normal = at.unscaled = edge.flat;
    at.normal_f = Vec3(0.0);
  }
  return at;
}

}  // namespace tangent
