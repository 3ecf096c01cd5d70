// A finger's core in floats, asked of four parts of the surface at a time what finger_core.h tells of one. All that
// rounding may change is made up for by asking for more.
#pragma once

#include "core/base/lanes.h"
#include "core/finger/finger_core.h"

#include <array>

namespace tangent {

/// Four parts, and a finger's way to each.
struct FourParts {
  std::array<Four, 3> away;  ///< from the middle of the part's box to the core's centre, m
  std::array<Four, 3> half;  ///< of the box
  std::array<Four, 3> axis;  ///< of the cone of normals, unit
  Four cos_half, sin_half, radius_m;
  Four way_m;    ///< that the finger may go
  Four far_m;    ///< parts that far outside the whole finger don't count (FingerCore::outside_at)
  Four deep_m;   ///< nor those over which the core's |A N| is no more than that; not over 0: not asked
  float room_m;  ///< by which coordinates and distances along an axis may be wrong
};

struct FourCore {
  FourCore() = default;
  explicit FourCore(const FingerCore& core);

  /// Whether it is certain that the finger touches no such part: it is too far outside the finger, or its planes are
  /// not deep enough, or the core's points for its normals miss their lines. Cones with cos_half up to `least_cosine`
  /// may be any.
  FourMask misses(const FourParts& parts, float least_cosine) const;

 private:
  Four largest_radius(const Four& least_length) const;
  Four slide(const Four& least_length, const Four& way) const;

  std::array<FourVec3, 3> rotation_{};  ///< columns
  FourVec3 axes_{}, squares_{};
  Four ball_{}, reach_{}, longest_{}, shortest_{}, sharpest_{}, flattest_{}, pair_{}, squares_sum_{}, turns_per_m_{};
  Four lever2_{};       ///< squared
  bool turns_ = false;  ///< the finger may turn, and its depth changes by that
};

}  // namespace tangent
