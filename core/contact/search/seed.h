// Contacts found without the kept plane: the first one and lost ones.
#pragma once

#include "core/contact/follow/iterate.h"

namespace tangent {

/// How far off a contact is, m; smaller is deeper. For a contact on the outside (h >= 0) it is the finger's
/// reach less the penetration, which for a sphere is h; a contact seen from inside ranks by how deep the finger's
/// centre is, after every outside contact that is nearer than that plus the reach.
inline double contact_rank(const Finger& finger, const PlaneContact& contact) {
  if (contact.height_m < 0.0) return contact.penetration_m;
  return (is_round(finger) ? round_radius_m(finger) : finger.reach_m()) - contact.penetration_m;
}

/// Bounds of a query that shall only see contacts of a rank below `rank`.
void limit_query(ContactQuery& query, const Finger& finger, double rank);

struct SeedResult {
  bool found = false;    ///< a converged contact
  IterationResult best;  ///< that, or the seed with the smallest error
  int evaluations = 0;   ///< of all seeds together
};

/// `paper` and `newton` start at the closest point of the nearest triangle and iterate to their limit.
/// `robust` tries every triangle that can hold a contact (ContactHierarchy), nearest first, and keeps the stable
/// contact of least rank; where there is none, or one implausibly far off, the kSeeds nearest triangles; then the
/// nearest place with its plane turned to face the finger. Where every contact is unstable the nearest of those counts.
/// `kept`: the plane that was tracked until now, if any; the nearest triangle is no further off than its triangle.
SeedResult seed_contact(IterationContext& context, const ContactScene& scene, const TrackedPlane& kept);

}  // namespace tangent
