// Proof that a part of a triangle holds no contact: its face, one of its creases or boundaries, or a corner where such
// edges end.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/context.h"
#include "core/contact/prove/contact_hierarchy.h"
#include "core/contact/prove/face_proof.h"

namespace tangent {

/// What of a triangle a search looks at.
struct PartOfTriangle {
  std::uint32_t triangle;
  SearchPart part = SearchPart::face;
};

/// Proof that a part holds no contact of a rank under `bound`; the margin is how far the centre may go until it could.
/// One under `enough_m` is worth some effort to widen. Of a region, `part` moves on to the triangle under the finger,
/// and the margin is how far the finger may go until it comes over the region, or until its place there ranks below
/// `bound`. Precondition: context.core of a finger that is not round.
PatchExclusion exclude_part(ContactContext& context, PartOfTriangle& part, const RankBound& bound,
                            double enough_m = 0.0);

/// Where a solve for a contact on that part starts.
SurfacePlace start_on(const ContactContext& context, const PartOfTriangle& part, const PatchExclusion& proof);

/// Whether on a part other than a region no centre nearer than `enough_m` to the context's has a contact of a rank
/// under `bound`, as far as a glance tells. `core`: of a finger that is not round, at the context's pose. What was
/// looked at is counted in `tests`.
bool excludes_at_a_glance(ContactContext& context, const FingerCore* core, const PartOfTriangle& part,
                          const RankBound& bound, double enough_m, int& tests);

}  // namespace tangent
