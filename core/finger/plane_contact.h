// The finger's contact with one tangent plane.
#pragma once

#include "core/finger/finger.h"

namespace tangent {

/// Support point of the finger projected on the plane through S with normal N.
struct PlaneContact {
  Vec3 travel{0.0};            ///< contact on the plane - S, m (the paper's travel vector)
  double height_m = 0.0;       ///< h: centre of the finger above the plane
  double penetration_m = 0.0;  ///< depth of the support point below the plane
  double error_m = 0.0;        ///< |travel|
};

/// For fingers other than point and sphere.
PlaneContact contact_of_support(const Finger& finger, const FingerPose& pose, const Vec3& point, const Vec3& normal);

/// A point or a sphere: its support point lies under its centre whatever the plane.
inline bool is_round(const Finger& finger) {
  return finger.shape == FingerShape::point || finger.shape == FingerShape::sphere;
}

/// Of a round finger: 0 for a point.
inline double round_radius_m(const Finger& finger) {
  return finger.shape == FingerShape::sphere ? finger.radius_m : 0.0;
}

/// For round fingers. In place: the solver's loop spares itself the copy.
inline void round_contact(double radius_m, const Vec3& centre, const Vec3& point, const Vec3& normal, PlaneContact& c) {
  const Vec3 d = centre - point;
  const double height = glm::dot(d, normal);
  const Vec3 travel = d - height * normal;
  c.travel = travel;
  c.error_m = std::sqrt(glm::dot(travel, travel));
  c.penetration_m = radius_m - height;
  c.height_m = height;
}

/// `pose` and `point` in the same frame; `normal`: unit.
inline void contact_on_plane(const Finger& finger, const FingerPose& pose, const Vec3& point, const Vec3& normal,
                             PlaneContact& c) {
  if (is_round(finger)) {
    round_contact(round_radius_m(finger), pose.position, point, normal, c);
  } else {
    c = contact_of_support(finger, pose, point, normal);
  }
}
inline PlaneContact contact_on_plane(const Finger& finger, const FingerPose& pose, const Vec3& point,
                                     const Vec3& normal) {
  PlaneContact c;
  contact_on_plane(finger, pose, point, normal, c);
  return c;
}

/// H = -(dp/dN + penetration I): how the travel answers a turn of the normal, d(travel) = -(dS + H dN) in
/// the plane. h I for a sphere. Metres.
Mat3 offset_derivative(const Finger& finger, const FingerPose& pose, const Vec3& normal, double penetration_m);

}  // namespace tangent
