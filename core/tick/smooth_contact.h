// The contact with the smooth surface in one tick: follow, prove, search, decide.
#pragma once

#include "core/contact/decide/decide.h"
#include "core/tick/tick.h"

namespace tangent {

/// `decided` of the last tick in, of this one out. `sample_is_kept`: decided.contact still is the plane and sample of
/// state.plane. The context's pose is local. Of the state only the clearance and how late it is are changed, where
/// something was looked at, and what is kept of `touched`: the other places that push together with the decided one;
/// null: none are asked for.
void find_smooth_contact(ContactContext& context, const SearchStructures& search, bool sample_is_kept, TickState& state,
                         DecidedContact& decided, TouchedContacts* touched);

}  // namespace tangent
