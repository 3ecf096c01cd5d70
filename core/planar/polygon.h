// A polygon in the plane, open or closed, as a file or a generator gives it: what the 2D algorithm smooths.
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"
#include "core/planar/exact_arc.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

/// Vertices in order, metres. A vertex given twice in a row is a sharp corner (Doxon et al., appendix).
/// Closed polygons do not repeat their first vertex at the end. The finger touches a closed polygon from outside,
/// whichever way it turns, and an open one from its left, as one goes along.
struct PlanarPolygon {
  std::string name;  ///< file or generator name, for messages
  std::vector<Vec2> vertices;
  bool closed = false;
  /// Where it is there, the finger touches this instead, and the vertices, near it, are for views and paths.
  std::optional<ExactArc> exact = std::nullopt;
};

inline constexpr std::size_t kMostPlanarVertices = 1'000'000;

double cross(const Vec2& a, const Vec2& b);           ///< z of the cross product
double signed_area_m2(const PlanarPolygon& polygon);  ///< of a closed one; positive: counter-clockwise

/// Whether the 2D algorithm can take it. Fails as check_exact_arc does, and, naming the vertices (from 0), on: fewer
/// than three different vertices; a coordinate that is not finite or beyond kLargestCoordinate; a vertex three times in
/// a row; a sharp corner at an open end; a segment that folds back onto the one before; segments that cross or touch;
/// ends that all but meet.
Status check_polygon(const PlanarPolygon& polygon);

/// Bounding-box centre to the origin, longest side to `longest_m`.
void fit_polygon(PlanarPolygon& polygon, double longest_m);

}  // namespace tangent
