// Where are the other places that the finger touches now?
#pragma once

#include "core/contact/follow/iterate.h"
#include "core/contact/touched.h"

namespace tangent {

struct FollowedPlaces {
  TouchedPlaces left;   ///< by over kLeftTouch, where they are now
  bool lost = false;    ///< one is found no more, or from inside only
  bool merged = false;  ///< one has, with the tracked one or another
  bool folded = false;  ///< one was unstable on the way, so that it may have leapt
};

/// The `kept` places, followed to the present pose by the `robust` rule, into `now`. Left out are those that the finger
/// has left, that have merged with the `tracked` one (null: there is none) or with each other, or got lost; walls
/// (tick/walls.h) are not looked at. `evaluations` grows by the planes that it took.
FollowedPlaces follow_touched(ContactContext& context, const TouchedPlaces& kept, const TrackedPlane* tracked,
                              TouchedContacts& now, int& evaluations);

/// Whether a place is found again from what a tick hands on of it. Along the flank of a long finger an edge may be
/// touched with more than one turn, and then it may not be.
bool can_be_followed(ContactContext& context, const TouchedContact& place, int& evaluations);

}  // namespace tangent
