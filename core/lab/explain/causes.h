// One function for each cause that a tick can have: true, or the cause, where it can be shown, and then the explanation
// holds what decided it, the place and the cure. Else the explanation is as it was.
#pragma once

#include "core/lab/explain/tick_study.h"

#include <optional>

namespace tangent {

// Of the finger's motion (motion_causes.cpp).
bool find_first(const TickStudy& study);   ///< nothing was tracked before, and a contact was found
bool find_turned_facet(TickStudy& study);  ///< the normal of a raw mesh's contact turned since the last tick
bool find_leap(TickStudy& study);          ///< the finger was put elsewhere
/// The tick did not search, since what it would have read was missing.
bool find_unready(TickStudy& study);

// Of other places (rival_causes.cpp).
bool find_rival(TickStudy& study);          ///< the followed contact was sound, and yet another took over
bool find_rivals_nearby(TickStudy& study);  ///< the planes of a sound contact's tick went into looking at others
/// Following took no more planes than a plain tick may.
bool others_were_the_trouble(const TickStudy& study);

// Of the mesh; preconditions: a 3D scene, and a run (mesh_causes.cpp).
bool find_sliver(TickStudy& study);
bool find_wild_normal(TickStudy& study);
std::optional<TickCause> find_feature(TickStudy& study);         ///< a crease or boundary that the run met
std::optional<TickCause> find_feature_to_end(TickStudy& study);  ///< a crease between the old contact and the new one
bool find_other_facet(TickStudy& study);  ///< another triangle, and the normal turned by more than a jump

// Of a 2D scene's polygon; precondition: a run (planar_causes.cpp).
std::optional<TickCause> find_planar_feature(TickStudy& study);  ///< a corner or an end that the run met

// Of the iteration (iteration_causes.cpp).
bool find_limit(TickStudy& study);
bool find_unstable(TickStudy& study);
std::optional<TickCause> find_gain(TickStudy& study);

}  // namespace tangent
