// How a contact answers the finger's motion: the derivative of contact point, normal and penetration with respect
// to the finger's position, from the same linear system as the Newton step.
//
// At a contact, travel(a, b, c) = 0 in the plane; moving the finger by dc moves the contact by the (da, db) that solve
// X_a da + X_b db = dc in the plane normal to N. Holds on faces, edges (a along the edge, b turning) and vertices.
#pragma once

#include "core/tick/step.h"

namespace tangent {

struct ContactDerivative {
  bool valid = false;                 ///< false where the contact is singular (det M = 0)
  Mat3 contact_by_position{0.0};      ///< dS/dc, 1
  Mat3 normal_by_position{0.0};       ///< dN/dc, 1/m
  Vec3 penetration_by_position{0.0};  ///< gradient of the penetration, 1; -N only if N is the surface's true normal
};

/// `plane`: a converged plane (TickState::plane after the tick); `pose`: the finger's of that tick, world. Fixed
/// orientation.
ContactDerivative contact_derivative(const ContactScene& scene, const Preset& preset, const FingerPose& pose,
                                     const TrackedPlane& plane);

}  // namespace tangent
