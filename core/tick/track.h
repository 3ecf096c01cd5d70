// Follows the contact from one tick to the next, finds it again when it is lost, and hands over to a deeper
// place elsewhere by the rule of the switch hysteresis.
#pragma once

#include "core/contact/search/seed.h"

namespace tangent {

struct TrackResult {
  IterationResult contact;  ///< the converged one, or the best there was
  TickEvent event = TickEvent::none;
  int evaluations = 0;  ///< of the whole tick, lost tracking and seeds included
  int triangle_changes = 0;
  bool converged() const { return contact.converged(); }
};

/// `result` of the last tick in, of this one out. `sample_kept`: result.contact still is the plane and sample of
/// state.plane. The context's pose is local. Of the state only the clearance is changed, where something was looked at.
void track(IterationContext& context, const ContactScene& scene, TickState& state, bool sample_kept,
           TrackResult& result);

}  // namespace tangent
