// Proof for fingers that are not round that a crease, or a vertex where two normals meet, holds no contact.
#pragma once

#include "core/contact/prove/feature_nets.h"
#include "core/finger/finger_core.h"

namespace tangent {

/// How far a finger may go, m, as gone_m counts, until a contact of whatever rank could come up on a crease that is all
/// but straight: by the sides to which the fan's planes draw it, and by where along the edge the finger's supports lie.
/// 0: no proof. A range of the fan is not looked at for more than a share of `enough_m`; at a `glance` the fan is
/// looked at as a whole. Adds to `tests` how many planes it has looked at. For core_feature_proof.h, which knows the
/// other reasons. Ours: the paper has no counterpart.
double crease_margin(const FingerCore& core, const CreaseNet& crease, double enough_m, bool glance, int& tests);

}  // namespace tangent
