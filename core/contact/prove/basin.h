// The surroundings of a known contact: triangles whose slope leads to it, so that no search needs to look at them.
//
// The finger's centre is at S + h N over a contact. Where that offset surface does not fold, a place has one contact;
// it folds where 1 + h k reaches zero along some direction, k the normal curvature (det M and trace M tell). Asked is
// therefore whether the way from the contact to a triangle and over it keeps clear of that.
#pragma once

#include "core/contact/patch_cache.h"
#include "core/contact/tracked_plane.h"

namespace tangent {

/// A contact whose surroundings need no search.
struct KnownContact {
  Feature feature = Feature::none;
  std::uint8_t side = 0;  ///< as in TrackedPlane
  std::uint32_t triangle = kNone;
  Vec3 point{0.0}, normal{0.0};  ///< S and unit N, local mesh coordinates, m
  double height_m = 0.0;         ///< of the finger's centre over the plane, signed
  double size_m = 0.0;           ///< longest side of its triangle
};

KnownContact known_contact(const ContactMesh& mesh, const TrackedPlane& plane, double height_m);

/// Whether triangle t belongs to the slope that leads to a known contact, as far as its corners, the middles of its
/// sides and the nine segments between them tell. Only near it, as far as the look-ahead `margin_m` calls for: further
/// off there may be a fold between.
bool same_basin(PatchCache& cache, NormalForm form, std::uint32_t t, const KnownContact& known, double margin_m);

}  // namespace tangent
