// Proofs for fingers that are not round, by their core (finger/finger_core.h).
//
// A contact on a face has p(n) - S(u,v) = lambda n, p the core's point for that normal. Within a patch p is all but
// linear in n: p(n) = p(A) + D n + e, e of second order in the angle from A, the middle of the normals. So the face of
// the finger is that of a point p(A) with the patch S - D n, a cubic as S is, and the proof that serves round fingers
// serves all, less |e|.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/context.h"
#include "core/contact/prove/face_proof.h"
#include "core/finger/finger_core.h"

namespace tangent {

/// Proof that the face of triangle t holds no contact of a rank under `bound`. Margins count as gone_m does. Of a
/// possible contact height_m is the rank (contact_rank.h); 0 where it is not known.
PatchExclusion exclude_face_by_core(ContactContext& context, const FingerCore& core, std::uint32_t t,
                                    const RankBound& bound, double enough_m);

/// Whether ground that is steady for this finger may be asked only for what it holds now: contacts deeper than the
/// finger's sharpest radius may fold anywhere, but one that comes up that deep was never entered (decide.h).
bool can_ask_steady(const FingerCore& core, double rank_m);

}  // namespace tangent
