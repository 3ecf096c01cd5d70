// How far to go from one tangent plane to the next: the paper's gain-scaled travel, the Newton step on
// c = S + h N, and the damped tangent step that `robust` takes where Newton's is no descent.
#pragma once

#include "core/contact/iterate.h"

namespace tangent {

/// A step in the two parameters of a place, with what the trace shows of it.
struct ParameterStep {
  double da = 0.0, db = 0.0;
  double gain = 0.0;
  double curvature_per_m = 0.0;
  double distance_m = 0.0;
  bool valid = false;  ///< false: no step can be computed here
};

/// The linear map from a parameter step to the change of travel, in the plane: travel -= X_a da + X_b db.
struct ContactJacobian {
  Vec3 xa, xb;  ///< S_a + H N_a, S_b + H N_b
};
ContactJacobian contact_jacobian(const Finger& finger, const FingerPose& pose, const PlaceSample& s, const PlaneContact& c);

/// det M and trace M of a face contact. A singular patch gives (0, 0), which is not stable.
Stability face_stability(const PlaceSample& s, const ContactJacobian& j);

/// Eq. 1: Gain = G_o / ((1 + G_k k)(1 + G_d |d|)).
double paper_gain(const SolverSettings& settings, double curvature_per_m, double distance_m);
/// d of Eq. 1 by the chosen reading.
double paper_distance(const SolverSettings& settings, const PlaneContact& c);

/// Paper 4.5 on a face: travel projected on the base triangle's plane, scaled by the gain.
ParameterStep paper_face_step(const ContactMesh& mesh, const SolverSettings& settings, std::uint32_t triangle,
                              const PlaceSample& s, const PlaneContact& c);

/// Solves X_a da + X_b db = travel in the plane normal to N.
ParameterStep newton_step(const PlaceSample& s, const ContactJacobian& j, const PlaneContact& c);

/// Newton where M is well inside the stable region, else the tangent step S_u du + S_v dv = travel, damped
/// by 1/(1 + |h| |dN/ds|); never longer than a few times the travel.
ParameterStep robust_face_step(const PlaceSample& s, const ContactJacobian& j, const Stability& stability,
                               const PlaneContact& c);

}  // namespace tangent
