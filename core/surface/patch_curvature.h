// Bounds of how a PN patch bends, over all of its places and directions: what tells at which heights the surface offset
// along its normals does not fold.
//
// A contact c = S + h N moves continuously with c where (S, h) -> S + h N has no fold. Along a tangent step dS that is
// so if dS.(P dS + h dN) > 0, P the projection along N: if 1 + h k stays above the squared sine of the angle between N
// and the surface's own normal, k = dN.dS / |dS|^2. The condition is convex, so it holds across smooth edges where it
// holds on both sides. Contacts on such ground appear and vanish at its border only: the ones that are there now are
// the ones that will be.
//
// Bounds are over products of Bezier coefficients, so by the convex-hull property they hold at every place.
#pragma once

#include "core/surface/pn_patch.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace tangent {

/// k of all places and directions, 1/m, positive where convex. Infinite both ways where nothing is known.
struct CurvatureBounds {
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();

  void include(const CurvatureBounds& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};

/// Whether the surface's own normal, S_u x S_v, is on the side of N at every place of a patch: certain where true.
bool keeps_front(const PnPatch& patch);

/// The same of one patch, found out when it is first asked.
class PatchFront {
 public:
  bool is_kept(const PnPatch& patch) {
    if (state_ == State::unknown) state_ = keeps_front(patch) ? State::kept : State::not_known;
    return state_ == State::kept;
  }

 private:
  enum class State : std::uint8_t { unknown, kept, not_known };
  State state_ = State::unknown;
};

/// For a patch with Bernstein normals (mixed_weight 2) that stay near the flat triangle's and near the surface's own;
/// infinite for all others.
CurvatureBounds curvature_bounds(const PnPatch& patch);

}  // namespace tangent
