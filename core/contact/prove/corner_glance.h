// What the corners of a face tell of all of it at a glance: mostly all that a search has to know of it.
#pragma once

#include "core/contact/patch_cache.h"

#include <cstdint>

namespace tangent {

/// Whether the corners tell that no centre nearer than `enough_m` (over 0) has a contact on the face: along the
/// direction of the middle of their misses (c - P) x N, or to the nearest of what lies between these, which is where
/// the least along any direction is most. As `corner_exclusion` asks it (face_proof.h), in floats, and less what these
/// are rounded by. Round fingers, local coordinates.
bool corners_exclude(PatchCache& cache, std::uint32_t t, NormalForm form, const Vec3& centre, double enough_m);

}  // namespace tangent
