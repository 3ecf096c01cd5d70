// Proof that a triangle holds no contact, face, edges and vertices together.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/context.h"
#include "core/contact/prove/contact_hierarchy.h"
#include "core/contact/prove/face_proof.h"
#include "core/contact/prove/feature_proof.h"

namespace tangent {

/// Proof that triangle t holds no contact of a rank under `bound`, its crease and boundary edges included; the margin
/// is how far the centre may go until it could. One under `enough_m` is worth some effort to widen. `memory`: features
/// that need not be looked at again, or null. Precondition: context.core of a finger that is not round.
/// Without `face` only its creases, boundaries and their ends are asked for (round fingers).
PatchExclusion exclude_triangle(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m = 0.0,
                                FeatureMemory* memory = nullptr, bool face = true);

/// What of a triangle a search looks at.
struct PartOfTriangle {
  std::uint32_t triangle;
  SearchPart part = SearchPart::whole;
};

/// exclude_triangle for a part. Of a region, `part` moves on to the triangle under the finger, and the margin is how
/// far the finger may go until it comes over the region, or until its place there ranks below `bound`. Without `face` a
/// whole triangle's face is not asked for.
PatchExclusion exclude_part(ContactContext& context, PartOfTriangle& part, const RankBound& bound,
                            double enough_m = 0.0, FeatureMemory* memory = nullptr, bool face = true);

/// Where a solve for a contact on that part starts.
SurfacePlace start_on(const ContactContext& context, const PartOfTriangle& part, const PatchExclusion& proof);

/// Of what of a triangle a glance tells that it holds no contact.
enum class GlanceExcludes : std::uint8_t { nothing, face, all };

/// Of what of triangle t no centre nearer than `enough_m` to the context's has a contact of a rank under `bound`, as
/// far as a glance tells. Round fingers.
GlanceExcludes glance_at(ContactContext& context, std::uint32_t t, const RankBound& bound, double enough_m,
                         FeatureMemory* memory);

}  // namespace tangent
