// Watches for contacts elsewhere that are, or may become, deeper than the tracked one.
//
// A search looks at every triangle that could hold one and notes how far the finger may go until it could: for the
// few triangles that are soonest one by one, for all others together. So most ticks ask nothing, and most of
// those that ask look at a triangle or two.
#pragma once

#include "core/contact/search/seed.h"

#include <cmath>

namespace tangent {

/// How far the support points of a finger that is not round can have moved while it turned from one orientation to the
/// other.
double turned_m(const Finger& finger, const Quat& from, const Quat& to);

/// How far the finger at `pose` (local) is from where the margins of `known` count from: its centre's displacement, and
/// for fingers that are not round the most that support points can have moved by its turning.
inline double gone_m(const Clearance& known, const Finger& finger, const FingerPose& pose) {
  const Vec3 d = pose.position - known.centre;
  const double centre_m = std::sqrt(glm::dot(d, d));
  return is_round(finger) ? centre_m : centre_m + turned_m(finger, known.orientation, pose.orientation);
}

/// Whether a finger that is `gone` from known.centre leaves room for a rival of a rank below `bound_m`.
inline bool rival_possible(const Clearance& known, double gone, double bound_m) {
  return gone > known.free_m || bound_m > known.height_m - gone;
}

/// The same knowledge seen from `pose`, `gone` away: what is left of the margins there.
void recentre(Clearance& known, const FingerPose& pose, double gone);

struct RivalResult {
  bool deeper = false;  ///< `best` is a stable contact whose rank is below the wanted bound
  IterationResult best;
  int evaluations = 0;
  Clearance clearance;  ///< until when nothing needs to be looked at again
};

/// `bound_m`: rank that a rival must be below to take over. `margin_m`: how far one would like to go without
/// searching again. `known`: the last search; the finger is `gone` from there. Beyond its margin all is searched,
/// within it only the watched triangles whose time has come. Uses the `robust` rule whatever the method.
RivalResult find_rival(IterationContext& context, const ContactScene& scene, const IterationResult& tracked,
                       double bound_m, double margin_m, const Clearance& known, double gone);

}  // namespace tangent
