// Where is the contact now? The first question of a tick: the kept plane is iterated on, and mostly that is all.
#pragma once

#include "core/contact/follow/iterate.h"

namespace tangent {

enum class Followed : std::uint8_t {
  held,      ///< converged where the kept contact leads
  branched,  ///< converged, but its solution folded on the way and the contact went over into another one by itself
  lost,      ///< not converged, or (robust) leapt to another place without folding
};

/// From the plane kept from the last tick. `sample_is_kept`: result.plane and result.sample still hold that plane.
/// `robust` gives up after kTrackBudget planes, the other methods after their iteration limit; they also keep what
/// leapt. Precondition: kept.feature is not none.
Followed follow(ContactContext& context, const TrackedPlane& kept, bool sample_is_kept, IterationResult& result);

/// A known contact seen from the context's pose, which may be that of another tick: one in a hollow crease as well.
void lead(ContactContext& context, const TrackedPlane& contact, IterationResult& result);

}  // namespace tangent
