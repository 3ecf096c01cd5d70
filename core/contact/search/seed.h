// Contacts found without the kept plane: the first one and lost ones.
#pragma once

#include "core/contact/clearance.h"
#include "core/contact/follow/iterate.h"
#include "core/contact/search/search_structures.h"
#include "core/contact/touched.h"

namespace tangent {

struct SeedResult {
  bool found = false;    ///< a converged contact, or the place that faces the finger where there is none
  IterationResult best;  ///< that, or the seed with the smallest error. Of a place that faces the finger `plane` is the
                         ///< facing one; travel and error are those of the plane with the surface's own normal.
  int evaluations = 0;   ///< of all seeds together
  bool searching = false;  ///< not all has been looked at yet: the next tick goes on
};

/// `paper` and `newton` start at the closest point of the nearest triangle and iterate to their limit.
/// `robust` tries every triangle that can hold a contact (ContactHierarchy), nearest first, and keeps the stable
/// contact of least rank; where there is none, or one implausibly far off, the kSeeds nearest triangles; then the
/// nearest place with its plane turned to face the finger. Where every contact is unstable the nearest of those counts,
/// of a finger that is not round as the place that faces it.
/// `kept`: the plane that was tracked until now, if any; the nearest triangle is no further off than its triangle.
/// `in_vain`: the last tick found no contact either, so that it saves time to look for one of any depth at once: the
/// same contacts. `parts`: where none is found near the raw mesh, a finger in motion is searched for in parts, a tick's
/// work each (search_work.h), and this is the search that is under way; a first search in real time that breaks off
/// leaves there where (go_on_with_start); null: at once. `entered`: a contact that is not
/// one of these comes after all that are.
SeedResult seed_contact(ContactContext& context, const SearchStructures& search, const TrackedPlane& kept,
                        bool in_vain = false, Clearance* parts = nullptr, const EnteredPlaces& entered = {});

/// A first search that broke off goes on, from the pose that it began at, with contacts deeper than the `tracked` one
/// there (null: there is none yet), and leads the deepest to the present pose. About a finger that has gone far since
/// it begins anew.
SeedResult go_on_with_start(ContactContext& context, const SearchStructures& search, const IterationResult* tracked,
                            Clearance& begun);

}  // namespace tangent
