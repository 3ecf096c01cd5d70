// Asymptotic convergence rate of the paper's iteration at a contact: the share of the error that one tangent plane
// leaves once the error is small.
//
// Near a contact a step of Eq. 1 takes the travel t to t - g(t/|t|) M t with M = B A^-1 (1 + h k along a principal
// direction of curvature k) and a gain g that depends only on the direction of t. That map is not linear, but
// homogeneous: |t| shrinks by a factor that converges with the direction. At a rounded edge of radius r, with gains
// that prevent overshoot across it, the travel turns until both components shrink alike, and every plane leaves
// (h/r)/(2 + h/r).
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/preset/preset.h"
#include "core/surface/pn_patch.h"

namespace tangent {

/// Pose of a finger that touches at the sample with this penetration: its centre or axis lies on the normal, its
/// orientation is the identity. World and mesh axes are parallel.
FingerPose pose_touching(const Finger& finger, const SurfaceSample& s, double penetration_m);

/// Largest rate over starting directions; 0: converges in one step, below 1: converges, 1 or more: cycles or diverges.
/// Infinite where no step can be computed. `s`: on patch `triangle`, local coordinates. Uses the preset's gains,
/// whatever its method.
double paper_contraction(const ContactMesh& mesh, std::uint32_t triangle, const SurfaceSample& s, const Preset& preset,
                         double penetration_m);

}  // namespace tangent
