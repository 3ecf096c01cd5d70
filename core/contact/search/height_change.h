// How far the finger may go before a contact that lies behind another one can overtake it.
#pragma once

#include "core/surface/pn_patch.h"

namespace tangent {

/// How a contact's height follows the finger's centre.
struct HeightChange {
  Vec3 rate{0.0};           ///< gradient, 1
  double bend_per_m = 0.0;  ///< how fast that turns, roughly
};

/// Of an edge or vertex contact, or of a finger that is not round: along the normal.
HeightChange height_change_along(const Vec3& normal, double height_m);

/// Of a round finger's contact on a face. From c = S + h N follows dh = N.dc - N.dS: the interpolated normal leans on
/// the surface, by some degrees on a coarse mesh, and near a fold the contact runs far over it.
HeightChange height_change_on_face(const SurfaceSample& sample, double height_m);

/// How far the centre may go before a rival that ranks `gap` behind can overtake, from how the two heights change.
/// `is_still`: the bound is a fixed height, and not the tracked contact's.
double overtaking_margin(const HeightChange& tracked, const HeightChange& rival, double gap, bool is_still);

}  // namespace tangent
