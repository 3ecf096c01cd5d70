// What a first look at a face asks of it besides its corners. It takes roots, so it is kept (contact/patch_cache.h).
#pragma once

#include "core/base/lanes.h"
#include "core/mesh/contact_mesh.h"
#include "core/surface/pn_patch.h"

#include <cstdint>

namespace tangent {

/// The three corners of a face, and the sides from each to the next, side by side in floats; the last is the first
/// again.
struct FaceLanes {
  FourVec3 at;       ///< of corners, from corner 0
  FourVec3 normals;  ///< at corners
  /// The control normals over the middles of the sides, from corner 0 to 1 and so on, in Bernstein form: none is longer
  /// than 1.
  FourVec3 middle_normals;
  float size_m;  ///< a corner's greatest distance from corner 0, rounded up
};

/// Local coordinates, m, of a usable triangle. Without initial values: a cache holds hundreds, most of them unused.
struct FaceOutline {
  Vec3 origin;       ///< corner 0
  bool has_middles;  ///< false: the normals at the ends of a side cancel out
  /// What the patch is off the flat triangle at most, times three, m: what sides lean out of their ends' planes, or the
  /// length of a crease.
  double lean_m;
  FaceLanes lanes;
};

FaceOutline face_outline(const ContactMesh& mesh, std::uint32_t t, NormalForm form);

}  // namespace tangent
