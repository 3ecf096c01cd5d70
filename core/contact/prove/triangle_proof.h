// Proof that a triangle holds no contact, face, edges and vertices together.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/context.h"
#include "core/contact/prove/face_proof.h"
#include "core/contact/prove/feature_proof.h"

namespace tangent {

/// Proof that triangle t holds no contact of a rank under `bound`, its crease and boundary edges included; the margin
/// is how far the centre may go until it could. One under `enough_m` is worth some effort to widen. `memory`: features
/// that need not be looked at again, or null. Precondition: context.core of a finger that is not round.
PatchExclusion exclude_triangle(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m = 0.0,
                                FeatureMemory* memory = nullptr);

/// Whether no centre nearer than `enough_m` to the context's has a contact of a rank under `bound` on triangle t, as
/// far as a glance tells. Round fingers.
bool excludes_at_a_glance(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m,
                          FeatureMemory* memory);

}  // namespace tangent
