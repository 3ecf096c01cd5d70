// Proof that a patch holds no contact for a finger centre, and for how far around it, without solving.
//
// Point and sphere contacts on a face have c - S(u,v) = h N(u,v), so with any two directions t and A
//   f(u,v) = ((c-S).t) (n.A) - (n.t) ((c-S).A) = 0,     n the normal before it is normalised.
// f is a quintic in Bernstein form over the triangle: a cubic times a quadratic. If its 21 coefficients have one
// sign it has no zero there, and because |n| <= 1 moving c by m changes it by no more than m: the smallest
// coefficient is the distance that c may move.
#pragma once

#include "core/surface/pn_patch.h"

namespace tangent {

struct PatchExclusion {
  double margin_m = 0.0;        ///< no centre nearer than this to c has a contact on the face; 0: not excluded
  double least_height_m = 0.0;  ///< lower bound of h of any contact on the face with h >= 0
};

/// `centre` in the patch's coordinates. Faces only: edges and vertices have fans of normals of their own.
PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre);

}  // namespace tangent
