// How fast the paper's iteration closes in on a contact: the share of the error that one tangent plane leaves, in the
// long run, once the error is small.
//
// Near a contact a step of Eq. 1 takes the travel t to t - g(t/|t|) M t with M = B A^-1 (1 + h k along a principal
// direction of curvature k) and a gain g that depends on the direction of t alone. That map is no matrix,
// but it is homogeneous: |t| shrinks by a factor that settles as the direction does. Across a straight edge of radius
// r, with gains that stop overshoot there, the travel turns until both parts shrink alike and every plane leaves
// (h/r)/(2 + h/r).
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/preset/preset.h"
#include "core/surface/pn_patch.h"

namespace tangent {

/// Finger touching at the sample with this penetration: its centre or axis lies along the normal, its orientation is
/// the identity. World and mesh axes are the same.
FingerPose pose_touching(const Finger& finger, const SurfaceSample& s, double penetration_m);

/// Largest over starting directions; 0: lands at once, below 1: converges, 1 and more: cycles or runs away. Infinite
/// where no step can be computed. `s`: on patch `triangle`, local coordinates. Gains are those of the preset, whatever
/// its method.
double paper_contraction(const ContactMesh& mesh, std::uint32_t triangle, const SurfaceSample& s, const Preset& preset,
                         double penetration_m);

}  // namespace tangent
