// The order in which contacts count: deepest first.
#pragma once

#include "core/finger/plane_contact.h"

namespace tangent {

/// How far off a contact is, m; smaller is deeper. For a contact on the outside (h >= 0) it is the finger's
/// reach less the penetration, which for a sphere is h; a contact seen from inside ranks by how deep the finger's
/// centre is, after every outside contact that is nearer than that plus the reach.
inline double contact_rank(const Finger& finger, const PlaneContact& contact) {
  const double reach = is_round(finger) ? round_radius_m(finger) : finger.reach_m();
  return reach - (contact.height_m < 0.0 ? contact.height_m : contact.penetration_m);
}

/// Whether a finger that is not round touches nothing, seen from this contact.
inline bool is_free(const Finger& finger, const PlaneContact& contact) {
  return !is_round(finger) && contact.height_m >= 0.0 && !(contact.penetration_m > 0.0);
}

/// Up to which rank contacts count, and how fast the gap to one behind it closes at most while the finger moves.
struct RankBound {
  double rank_m = 0.0;
  double closing = 2.0;  ///< 1: the bound stays where it is; 2: it may rise by as much as the finger moves
  /// How far the finger may go before a contact of rank `rank` now is one that counts.
  double way_to(double rank) const { return (rank - rank_m) / closing; }
  /// What counts after that way.
  double after(double way_m) const { return rank_m + closing * way_m; }
};

}  // namespace tangent
