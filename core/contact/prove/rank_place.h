// Where on a patch a finger that is not round has the contact that a proof found possible, and how deep it is.
#pragma once

#include "core/contact/context.h"
#include "core/contact/prove/face_proof.h"
#include "core/finger/finger_core.h"

namespace tangent {

/// From (u, v) of `proof`, Newton's steps over the patch, each halved while it leads to a longer travel. Where they
/// arrive at a contact that surely is stable, (u, v) and the point become its, and height_m its rank (contact_rank.h);
/// else they stay, and height_m is 0. Returns the travel at the place that it began at, m.
double rank_place(const ContactContext& context, const FingerCore& core, const PnPatch& patch, PatchExclusion& proof);

}  // namespace tangent
