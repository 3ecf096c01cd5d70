// First contacts and lost ones: contacts found from the nearest triangles instead of the kept plane.
#pragma once

#include "core/contact/iterate.h"
#include "core/contact/nearest_triangles.h"

namespace tangent {

struct SeedResult {
  bool found = false;        ///< a converged contact
  IterationResult best;      ///< that, or the seed with the smallest error
  int evaluations = 0;       ///< of all seeds together
  int seeds = 0;
};

/// `paper` and `newton` start at the closest point of the nearest triangle and iterate to their limit.
/// `robust` tries the kSeeds nearest triangles and keeps the stable contact nearest to the finger's centre
/// (least |height|); it stops when no further triangle can hold a nearer one.
SeedResult seed_contact(IterationContext& context, const NearestTriangles& nearest);

}  // namespace tangent
