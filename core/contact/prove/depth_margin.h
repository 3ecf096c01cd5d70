// What is excluded by how deep a finger that is not round can be over a part of the surface.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/finger/finger_core.h"

namespace tangent {

/// How far the finger may go, m, until a contact with one of these normals could have a rank under the bound; not over
/// 0: nothing is known.
inline double margin_by_depth(const FingerCore& core, const NormalCone& normals, const RankBound& bound) {
  return bound.rank_m < core.deep_rank_m() ? bound.way_to(core.least_rank(normals)) : 0.0;
}

}  // namespace tangent
