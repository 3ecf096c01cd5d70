// What pushes on a circle in the plane besides the tracked place: what its god-object touches.
//
// A corner pushes from both its sides. The circle is led out of the tracked place; what it is still in from there is
// one more place, out of which it is led, too, until there is none. A wall that ends in an inner corner holds no
// contact any more for a circle that is deep in the other one, but for the circle that is led out it does. And what the
// circle is out of by then needs no plane: it does not change the way. Places of the last tick are asked first, from
// where they led the circle out: led out of one side of a sharp notch alone, a deep circle may come to lie behind the
// other.
#pragma once

#include "core/planar/track.h"
#include "core/tick/tick.h"

namespace tangent {

/// Places besides the tracked one, and the way out of all. A place is kept as TouchedPlaces has it, `triangle` its
/// patch, `u` its parameter, `v` the direction of its normal from x to y, rad.
struct PlanarWayOut {
  Vec3 way_out_m{0.0};  ///< zero: the tracked place alone pushes, or nothing does
  TouchedPlaces places;
  bool leapt = false;  ///< the way has, as where other places push than at the last tick
  int evaluations = 0;
};

/// Of a converged `track`; `before` is what the last tick left. None is a place that was not entered
/// (contact/decide/decide.h), or that the circle's centre is behind of where it is led out. A point is in no second
/// place from there: its corner is a place by itself.
PlanarWayOut find_planar_way_out(const PlanarContext& context, const PlanarTrack& track, const TickState& before);

}  // namespace tangent
