// The finger's contact with one tangent plane (ALGORITHM.md 3).
#pragma once

#include "core/contact/finger.h"

namespace tangent {

/// Support point of the finger projected on the plane through S with normal N.
struct PlaneContact {
  Vec3 travel{0.0};            ///< contact on the plane - S, m (the paper's travel vector)
  double error_m = 0.0;        ///< |travel|
  double penetration_m = 0.0;  ///< depth of the support point below the plane
  double height_m = 0.0;       ///< h: centre of the finger above the plane
};

/// `pose` and `point` in the same frame; `normal`: unit.
PlaneContact contact_on_plane(const Finger& finger, const FingerPose& pose, const Vec3& point, const Vec3& normal);

/// H = -(dp/dN + penetration I): how the travel answers a turn of the normal, d(travel) = -(dS + H dN) in
/// the plane. h I for a sphere. Metres.
Mat3 offset_derivative(const Finger& finger, const FingerPose& pose, const Vec3& normal, double penetration_m);

}  // namespace tangent
