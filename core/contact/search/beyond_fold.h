// From an unstable contact to the stable ones beside it.
//
// At a fold two contacts come up side by side, a stable one and an unstable one, and a solve that starts at the wrong
// one stays there: the steps from it are as long as the travel, which vanishes. A contact that follows its travel,
// ds/dt = travel = -M ds, leaves a saddle along the eigenvector of M whose eigenvalue is negative, to either side. So
// the stable one lies that way, beyond the line where det M vanishes.
#pragma once

#include "core/contact/follow/iterate.h"

namespace tangent {

/// `unstable`: where a run on a face ended. Looks from there to one side (`sign` 1 or -1), up to 16 sides of a triangle
/// away, for ground where contacts are stable, and iterates from it with `budget` new planes. False where there is
/// none, or no contact is found from it. The evaluations are those of the way, too.
bool iterate_beyond_fold(ContactContext& context, const IterationResult& unstable, double sign, int budget,
                         IterationResult& result);

}  // namespace tangent
