// Proof that a crease, boundary or vertex holds no contact, and for how far around the centre.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/patch_cache.h"

#include <cstdint>

namespace tangent {

/// A crease or boundary edge of a triangle, or one of its corners where such edges end.
struct TriangleFeature {
  std::uint32_t triangle;
  std::uint32_t number;  ///< of the edge or corner
  bool is_corner = false;
};

struct FeatureExclusion {
  /// How far the centre may go until a contact that counts can come up there; 0 where one may be there now.
  double margin_m = 0.0;
  bool by_rank = true;  ///< as of PatchExclusion
  int tests = 0;        ///< what was looked at, in tests of a patch (search_work.h)
};

/// Asks for contacts of a rank under `bound`. On an edge, its ends left out, none is where the centre is beyond its
/// ends, seen along it from every place of it, or over one of its faces and not over the fan between them, or too far
/// off; where that tells nothing of the whole edge, it is asked of its halves, and so on. A margin under `enough_m` is
/// worth some effort to widen, or, at a `glance`, nothing. Round fingers.
FeatureExclusion exclude_feature_contacts(PatchCache& cache, const TriangleFeature& feature, NormalForm form,
                                          const Vec3& centre, const RankBound& bound, double enough_m = 0.0,
                                          bool glance = false);

}  // namespace tangent
