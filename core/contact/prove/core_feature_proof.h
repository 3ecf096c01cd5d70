// Proof for fingers that are not round that a crease or a vertex holds no contact.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/context.h"
#include "core/contact/prove/feature_proof.h"
#include "core/finger/finger_core.h"

namespace tangent {

/// Asks a crease, boundary or corner for contacts of a rank under `bound`; margins count as gone_m does. Of boundaries
/// only their distance is asked. Once a margin is `enough_m`, no more is asked for; at a `glance` only the whole of it.
FeatureExclusion exclude_feature_by_core(ContactContext& context, const FingerCore& core,
                                         const TriangleFeature& feature, const RankBound& bound, double enough_m,
                                         bool glance = false);

}  // namespace tangent
