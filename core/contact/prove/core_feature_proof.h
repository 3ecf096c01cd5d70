// Proof for fingers that are not round that the crease edges and vertices of a triangle hold no contact.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/context.h"
#include "core/contact/prove/feature_proof.h"
#include "core/finger/finger_core.h"

namespace tangent {

/// How far the finger may go, as gone_m counts, until a contact of a rank under `bound` on these creases or on their
/// ends can come up; the largest double where there are none, 0 where one may be there now, and on boundaries,
/// of which nothing is proved.
double exclude_features_by_core(ContactContext& context, const FingerCore& core, const TriangleFeatures& features,
                                const RankBound& bound);

}  // namespace tangent
