// Can another place be deeper by now? Asked at every tick, answered without looking at the surface: from how far the
// finger has gone since the last search found out (contact/clearance.h).
#pragma once

#include "core/contact/clearance.h"
#include "core/contact/surface_place.h"
#include "core/finger/plane_contact.h"
#include "core/mesh/contact_mesh.h"

#include <cmath>
#include <limits>

namespace tangent {

/// The way of the finger's furthest point while a finger that is not round turned from one orientation to the other, m.
double turned_m(const Finger& finger, const Quat& from, const Quat& to);

/// How far the finger at `pose` (local) is from where the margins of `known` count from, m: its centre's displacement,
/// and for fingers that are not round what its turning adds, or infinity where they hold at one orientation only. No
/// depth changes by more.
inline double gone_m(const Clearance& known, const Finger& finger, const FingerPose& pose) {
  const Vec3 d = pose.position - known.centre;
  const double centre_m = std::sqrt(glm::dot(d, d));
  if (is_round(finger)) return centre_m;
  if (!known.any_turn && known.orientation != pose.orientation) return std::numeric_limits<double>::infinity();
  return centre_m + turned_m(finger, known.orientation, pose.orientation);
}

/// The same from the middle of the look-ahead, which it has reached without turning.
inline double gone_ahead_m(const Clearance& known, const FingerPose& pose, double gone) {
  if (known.ahead_centre == known.centre) return gone;
  const Vec3 d = pose.position - known.ahead_centre, from = pose.position - known.centre;
  return std::sqrt(glm::dot(d, d)) + (gone - std::sqrt(glm::dot(from, from)));
}

/// Whether a search of everything is called for: a finger at `pose`, `gone` from known.centre, may have come to what
/// was not looked at of places of a rank below `bound_m`.
inline bool is_beyond(const Clearance& known, const FingerPose& pose, double gone, double bound_m) {
  const double ahead = gone_ahead_m(known, pose, gone);
  return gone > known.margin_m || ahead > known.ahead_m || bound_m > known.ahead_height_m - ahead ||
         bound_m > known.height_m;
}

/// Whether there may be a place of a rank below `bound_m` that is not known.
inline bool deeper_possible(const Clearance& known, const FingerPose& pose, double gone, double bound_m) {
  return gone > known.free_m || is_beyond(known, pose, gone, bound_m);
}

/// Whether a finger that came `moved_m` straight here since the last tick was within one of two margins all the way:
/// `then_m` from a place that was `before_m` away at the last tick, within that margin, and is `now_m` away, or
/// `here_m` from here.
bool stayed_within(double then_m, double before_m, double now_m, double here_m, double moved_m);

/// The least of the margins, as the radius up to which nothing is asked.
void set_free(Clearance& known);

/// A place was found that is not followed, so that its surroundings are not known: a finger that is `gone` from
/// known.centre looks everywhere when it has gone `within_m` further, at 0 with the next tick.
void forget_surroundings(Clearance& known, double gone = 0.0, double within_m = 0.0);

/// The next look is at that place, which is followed no more, and from there on it is watched. False: nothing is known
/// that it could be added to, or there is no room.
bool watch_again(Clearance& known, const ContactMesh& mesh, const SurfacePlace& place);

/// The same knowledge seen from `pose`, `gone` away: what is left of the margins there.
void recentre(Clearance& known, const FingerPose& pose, double gone);

}  // namespace tangent
