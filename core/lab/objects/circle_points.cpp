#include "core/lab/objects/circle_points.h"

#include <cassert>
#include <numbers>
#include <utility>

namespace tangent {

// Folds the angle into the first octant in integers, so that symmetric angles use the same call of sin and cos.
Vec2 circle_point(std::int64_t numerator, std::int64_t denominator) {
  assert(denominator > 0);
  const std::int64_t octant = denominator;  // in units of 1/(8 denominator) turn
  std::int64_t angle = 8 * (numerator % denominator);
  if (angle < 0) angle += 8 * octant;
  const bool below = angle > 4 * octant;
  if (below) angle = 8 * octant - angle;
  const bool behind = angle > 2 * octant;
  if (behind) angle = 4 * octant - angle;
  const bool steep = angle > octant;
  if (steep) angle = 2 * octant - angle;

  const double radians = 2.0 * std::numbers::pi * static_cast<double>(angle) / (8.0 * static_cast<double>(octant));
  Vec2 point(std::cos(radians), std::sin(radians));
  if (angle == octant) point = Vec2(std::numbers::sqrt2 / 2.0);
  if (steep) std::swap(point.x, point.y);
  if (behind) point.x = -point.x;
  if (below) point.y = -point.y;
  return point;
}

}  // namespace tangent
