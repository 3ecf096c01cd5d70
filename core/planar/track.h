// Follows the contact on a planar curve from tick to tick, finds it again, and hands over to a nearer place elsewhere.
#pragma once

#include "core/contact/decide/tick_event.h"
#include "core/planar/follow.h"

namespace tangent {

struct PlanarTrack {
  PlanarContact contact;
  TickEvent event = TickEvent::none;
  int evaluations = 0, patch_changes = 0;
  bool unentered = false;  ///< found from behind (contact/decide/decide.h): it does not push until it is left
  bool converged() const { return contact.converged(); }
};

/// What a tick needs to know of the last one.
struct PlanarKept {
  PlanarPlace place;       ///< feature none: nothing is tracked
  double depth_m = 0.0;    ///< of the last line that was rendered, at the present pose; 0: none, or not touched
  bool unentered = false;  ///< of the place
};

/// Each tick asks the index for the patches that could hold a place nearer than the tracked one by more than the
/// hysteresis, the tracked one's own patch among them, and solves on those. One that the finger can't have entered from
/// outside does not take over, nor does the far side of what it is in. `others_push`: touched places beside the tracked
/// one push, too, so which of them it is matters to the display alone, and only one that is nearer by more than a
/// tremor takes over.
PlanarTrack track_planar(PlanarContext context, const PlanarKept& kept, bool others_push = false);

}  // namespace tangent
