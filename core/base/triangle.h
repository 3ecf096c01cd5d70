// Closest point of a flat triangle, exact to double rounding.
#pragma once

#include "core/base/vec.h"

namespace tangent {

struct TrianglePoint {
  Vec3 point{0.0};
  double u = 0.0, v = 0.0;  ///< barycentric weights of b and c
  double distance2 = 0.0;   ///< to the query point, m^2
};

/// Closest point of triangle (a, b, c) to `q`, by Voronoi regions (Ericson, "Real-Time Collision Detection",
/// 5.1.5). Degenerate triangles give a point of theirs.
TrianglePoint closest_point_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q);

}  // namespace tangent
