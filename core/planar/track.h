// Follows the contact on a planar curve from tick to tick, finds it again, and hands over to a nearer place elsewhere.
#pragma once

#include "core/contact/decide/tick_event.h"
#include "core/planar/follow.h"

namespace tangent {

struct PlanarTrack {
  PlanarContact contact;
  TickEvent event = TickEvent::none;
  int evaluations = 0, patch_changes = 0;
  bool converged() const { return contact.converged(); }
};

/// `kept`: the last tick's place; feature none: nothing is tracked. Each tick asks the index for the patches that could
/// hold a place nearer than the tracked one by more than the hysteresis, the tracked one's own patch among them, and
/// solves on those.
PlanarTrack track_planar(PlanarContext context, const PlanarPlace& kept);

}  // namespace tangent
