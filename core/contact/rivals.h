// Watches for contacts elsewhere that are, or may become, deeper than the tracked one.
//
// A search looks at every triangle that could hold one and notes how far the finger may go until it could: for the
// few triangles that are soonest one by one, for all others together. So most ticks ask nothing, and most of
// those that ask look at a triangle or two.
#pragma once

#include "core/contact/seed.h"

namespace tangent {

/// What is left of `known` once the finger stands at `pose` (local). Negative margins: look again.
void age(Clearance& known, const Finger& finger, const FingerPose& pose);

struct RivalResult {
  bool deeper = false;       ///< `best` is a stable contact whose rank is below the wanted bound
  IterationResult best;
  int evaluations = 0;
  Clearance clearance;       ///< until when nothing needs to be looked at again
};

/// `bound_m`: rank that a rival must be below to take over. `margin_m`: how far one would like to go without
/// searching again. `known`: what is left of the last search; a negative margin asks for a whole one.
/// Uses the `robust` rule whatever the method.
RivalResult find_rival(IterationContext& context, const ContactScene& scene, const IterationResult& tracked,
                       double bound_m, double margin_m, const Clearance& known);

/// Whether `known`, aged to the present pose, leaves room for a rival of a rank below `bound_m`.
bool rival_possible(const Clearance& known, double bound_m);

}  // namespace tangent
