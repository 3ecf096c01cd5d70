// The core of a finger that is not round, over a part of a patch: all but linear in the normal.
//
// With y0 = A N0 for the middle N0 of the normals, any other normal N along N0 + tau has y = y0 + A tau. Split A tau
// into b along y0 and w across it, and g = y / |y| is g0 + w / |y0| but for
//   w (1 / sqrt((|y0| + b)^2 + w^2) - 1 / |y0|)   across y0, and
//   (|y0| + b) / sqrt((|y0| + b)^2 + w^2) - 1       along it, never above 0.
// tau of a patch's normals lies in the hull of those of its control normals, so b and |w| do.
#pragma once

#include "core/finger/finger_core.h"
#include "core/surface/pn_patch.h"

#include <array>
#include <limits>

namespace tangent {

/// p(n) - `point` = scale * D n but for an error e, D the derivative at the support of the normals' middle.
struct LinearCore {
  CoreSupport support;  ///< of the middle
  Vec3 point{0.0};
  double scale = 1.0;
  std::array<Vec3, 6> slopes;  ///< D tau of the control normals: e lies in the hull of +-`slope_share` of them ...
  double slope_share = 0.0;
  Vec3 bend{0.0};               ///< ... and of +-this, both across the middle normal ...
  double along_m = 0.0;         ///< ... and within this along it, ...
  double rest_m = 0.0;          ///< ... which seen along the plane of any normal is less than this
  double least_length_m = 0.0;  ///< |A N| at least
  double off_m = std::numeric_limits<double>::infinity();  ///< e seen along any normal's plane, at most
};

/// The same of a core as thin as a capsule's for any normals, and any way the finger goes and turns: p(n) is all but on
/// the long axis. Infinite off_m: it is not thin.
LinearCore segment_core(const FingerCore& core, const std::array<Vec3, 6>& normals, const Vec3& axis);

/// `normals`: control normals in Bernstein form; `axis`: the middle of their directions. Where off_m is `most_off_m` or
/// more, it is told as infinite.
LinearCore linear_core(const FingerCore& core, const std::array<Vec3, 6>& normals, const Vec3& axis,
                       double most_off_m = std::numeric_limits<double>::infinity());

/// A part of a patch as a patch of its own, with Bernstein normals, none of them longer than 1.
struct PatchPiece {
  PnPatch patch;
  std::array<Vec2, 3> corner{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0)};  ///< (u, v) in the whole
  int depth = 0;

  explicit PatchPiece(const PnPatch& whole);
  PatchPiece() = default;
  Vec2 at(double u, double v) const { return corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]); }
};

/// Its halves at the middle of the edge from corner 0 to corner 1. That edge is another one in them.
void bisect(const PatchPiece& piece, PatchPiece& first, PatchPiece& second);

}  // namespace tangent
