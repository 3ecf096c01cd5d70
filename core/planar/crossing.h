// Whether a polygon crosses or touches itself: Shamos & Hoey, "Geometric intersection problems", FOCS 1976. A line
// sweeps over the plane and keeps the segments that it meets in their order along it: two that cross are neighbours in
// that order just before, so only neighbours are compared. O(n log n), however many segments the line meets at once.
#pragma once

#include "core/base/vec.h"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace tangent {

struct PlanarSegment {
  Vec2 a, b;             ///< different, m
  std::size_t from = 0;  ///< vertex at a
};

/// The two segments' indices, the lower one first, of a pair that have a place in common; none: there is no such pair.
/// Segments that follow one another share a vertex and are not asked about (`closed`: the last and the first, too).
/// Precondition: none folds back onto the one before.
std::optional<std::pair<std::size_t, std::size_t>> find_crossing(std::span<const PlanarSegment> segments, bool closed);

}  // namespace tangent
