// What the corners of a face tell of all of it, by their places and normals alone, without its patch: mostly all that a
// search has to know. Round fingers, local coordinates. In floats, less what these are rounded by.
#pragma once

#include "core/contact/patch_cache.h"

#include <cstdint>

namespace tangent {

/// How far from a centre another has to be to have a contact on the face, as far as the direction of the middle of the
/// corners' misses (c - P) x N tells: along it the misses of the flat triangle with the normals as they are a cubic,
/// and the patch is off that by a third of what sides lean out of their ends' planes at most, or of a crease's length.
/// 0: look closer.
double corner_exclusion(PatchCache& cache, std::uint32_t t, NormalForm form, const Vec3& centre);

/// Whether the corners tell that no centre nearer than `enough_m` (over 0) has a contact on the face: along that
/// direction, or to the nearest of what lies between the misses, which is where the least along any direction is most.
bool corners_exclude(PatchCache& cache, std::uint32_t t, NormalForm form, const Vec3& centre, double enough_m);

}  // namespace tangent
