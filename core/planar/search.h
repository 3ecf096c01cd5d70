// Stable contacts of a finger with a planar curve wherever they are, and the nearest of them. Nearest is meant on
// either side of the surface: a finger deep in a wall belongs to the side it is closest to.
#pragma once

#include "core/planar/follow.h"

namespace tangent {

/// Contacts that are asked for.
struct PlanarRival {
  double below_m = 0.0;   ///< |height| less than this; infinity allowed
  PlanarPlace besides;    ///< the contact that is known already; feature none: none is
  bool in_front = false;  ///< the finger's centre is: none from behind
};

/// What a search has come to.
struct PlanarWork {
  int evaluations = 0;  ///< lines that contacts were iterated with
  int looks = 0;        ///< places of hollow patches looked at to tell in which parts there may be one
};

/// The nearest of the contacts that patch `i` holds, one or several, as `rival` asks for; false: there is none. `work`
/// grows.
bool nearest_on_patch(const PlanarContext& context, std::uint32_t i, const PlanarRival& rival, PlanarContact& best,
                      PlanarWork& work);

/// The nearest of all, of equally near ones that of the lowest patch. Asks the patches that are near enough and face
/// the finger; of more than 512 of them, the first that the index comes to.
bool nearest_contact(const PlanarContext& context, PlanarRival rival, PlanarContact& best, PlanarWork& work);

/// The patch that is nearest to the finger's centre, judged by its ends and its middle, and how near these are. Where
/// more than 4,096 are as near but for a few segments' lengths, one of those.
std::uint32_t nearest_patch(const PlanarContext& context, double& distance_m);

}  // namespace tangent
