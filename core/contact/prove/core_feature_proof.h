// Proof for fingers that are not round that the crease edges and vertices of a triangle hold no contact.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/context.h"
#include "core/contact/prove/face_proof.h"
#include "core/contact/prove/feature_proof.h"
#include "core/finger/finger_core.h"

#include <array>
#include <cstdint>

namespace tangent {

struct FeatureExclusion {
  /// How far the finger may go, as gone_m counts, until a contact can come up on the features that were asked; the
  /// largest double where there are none, 0 where one may be there now, and on boundaries, of which nothing is proved.
  double margin_m = 0.0;
  std::uint64_t unproved = PatchExclusion::kNoFeature;  ///< where that is 0: the first of which nothing is proved
  std::array<std::uint64_t, 6> asked{};                 ///< what FeatureMemory calls them
  std::size_t asked_count = 0;
  int tests = 0;  ///< parts looked at: their cost
};

/// Asks the creases and boundaries and their ends for contacts of a rank under `bound`, but for those that `memory`
/// knows. Once a margin is `enough_m`, no more is asked for; at a `glance` only each as a whole.
FeatureExclusion exclude_features_by_core(ContactContext& context, const FingerCore& core,
                                          const TriangleFeatures& features, const RankBound& bound, double enough_m,
                                          const FeatureMemory* memory = nullptr, bool glance = false);

}  // namespace tangent
