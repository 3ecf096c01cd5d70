// Proof for fingers that are not round that a crease, or a vertex where two normals meet, holds no contact.
#pragma once

#include "core/contact/prove/feature_parts.h"
#include "core/finger/finger_core.h"

namespace tangent {

/// How far a finger may go until a contact could come up on a crease that is all but straight: by the sides to which
/// the fan's planes draw it, and by where along the edge the finger's supports lie. 0: no proof. At a `glance` the
/// fan is looked at as a whole. Adds to `tests` what it has looked at.
double crease_margin(const FingerCore& core, const CreasePart& crease, double enough_m, bool glance, int& tests);

}  // namespace tangent
