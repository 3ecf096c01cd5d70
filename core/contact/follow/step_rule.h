// How far to go from one tangent plane to the next: the paper's gain-scaled travel, the Newton step on
// c = S + h N, and the damped tangent step that `robust` takes where Newton's is no descent.
#pragma once

#include "core/base/tolerances.h"
#include "core/contact/follow/iteration.h"

#include <algorithm>
#include <cmath>

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
inline ContactJacobian round_jacobian(const SurfaceSample& s, double height_m) {
  return {s.point_u + height_m * s.normal_u, s.point_v + height_m * s.normal_v};
}
inline ContactJacobian contact_jacobian(const Finger& finger, const FingerPose& pose, const SurfaceSample& s,
                                        const PlaneContact& c) {
  if (is_round(finger)) return round_jacobian(s, c.height_m);
  const Mat3 h = offset_derivative(finger, pose, s.normal, c.penetration_m);
  return {s.point_u + h * s.normal_u, s.point_v + h * s.normal_v};
}

/// det M and trace M of a face contact. A singular patch gives (0, 0), which is not stable.
inline Stability face_stability(const SurfaceSample& s, const ContactJacobian& j) {
  // With 2D cross products in the plane: det M = (Xa x Xb)/(Sa x Sb), trace M = (Xa x Sb + Sa x Xb)/(Sa x Sb).
  const Vec3 sb_turned = glm::cross(s.point_v, s.normal), xb_turned = glm::cross(j.xb, s.normal);
  const double area = glm::dot(s.point_u, sb_turned);
  if (area == 0.0) return {0.0, 0.0};
  const double per_area = 1.0 / area;
  return {glm::dot(j.xa, xb_turned) * per_area,
          (glm::dot(j.xa, sb_turned) + glm::dot(s.point_u, xb_turned)) * per_area};
}

/// Sum and product of the curvatures of the normals at a sample: with X = S + h N above, M = I + h W, W the map of dS
/// to dN in the plane.
inline NormalBend normal_bend(const SurfaceSample& s) {
  const Vec3 sb_turned = glm::cross(s.point_v, s.normal), nb_turned = glm::cross(s.normal_v, s.normal);
  const double area = glm::dot(s.point_u, sb_turned);
  if (area == 0.0) return {0.0, 0.0, 0.0, 0.0};
  const double per_area = 1.0 / area;
  return {1.0, (glm::dot(s.normal_u, sb_turned) + glm::dot(s.point_u, nb_turned)) * per_area,
          glm::dot(s.normal_u, nb_turned) * per_area, area};
}

/// Eq. 1: Gain = G_o / ((1 + G_k k)(1 + G_d |d|)).
double paper_gain(const SolverSettings& settings, double curvature_per_m, double distance_m);
/// d of Eq. 1 by the chosen reading.
double paper_distance(const SolverSettings& settings, const PlaneContact& c);

/// Paper 4.5 on a face: travel projected on the base triangle's plane, scaled by the gain.
ParameterStep paper_face_step(const ContactMesh& mesh, const SolverSettings& settings, std::uint32_t triangle,
                              const SurfaceSample& s, const PlaneContact& c);

/// The tangent step S_u du + S_v dv = travel, damped by 1/(1 + |h| |dN/ds|).
ParameterStep damped_step(const SurfaceSample& s, const PlaneContact& c);

/// Solves X_u du + X_v dv = travel in the plane normal to N. `det`: X_u x X_v . N.
inline ParameterStep newton_step(const SurfaceSample& s, const ContactJacobian& j, const PlaneContact& c, double det) {
  ParameterStep step;
  const Vec3 xb_turned = glm::cross(j.xb, s.normal);  // dot with a vector x gives (x cross xb).N
  const double per_det = 1.0 / det;
  step.da = glm::dot(c.travel, xb_turned) * per_det;
  step.db = glm::dot(glm::cross(j.xa, c.travel), s.normal) * per_det;
  step.valid = std::isfinite(step.da) && std::isfinite(step.db);
  step.distance_m = c.penetration_m;
  step.gain = 1.0;
  return step;
}

inline ParameterStep newton_step(const SurfaceSample& s, const ContactJacobian& j, const PlaneContact& c) {
  return newton_step(s, j, c, glm::dot(j.xa, glm::cross(j.xb, s.normal)));
}

/// Where Newton's step is taken without a second look: M is well inside the stable region, and the step short against
/// the triangle.
inline bool trusts_newton(const Stability& stability) { return stability.det > kNewtonMinDet && stability.trace > 0.0; }
inline bool is_short(const ParameterStep& step) { return std::max(std::abs(step.da), std::abs(step.db)) <= kShortStep; }

/// Newton's step where M is well inside the stable region, never longer than a few times the travel unless it is short
/// against the triangle; else the damped one. `area`: S_u x S_v . N.
inline ParameterStep robust_face_step(const SurfaceSample& s, const ContactJacobian& j, const Stability& stability,
                                      const PlaneContact& c, double area) {
  if (!trusts_newton(stability)) return damped_step(s, c);
  ParameterStep step = newton_step(s, j, c, area * stability.det);
  if (!step.valid) return damped_step(s, c);
  if (is_short(step)) return step;
  const Vec3 ds = step.da * s.point_u + step.db * s.point_v;
  const double limit2 = kLongestStepPerTravel * kLongestStepPerTravel * c.error_m * c.error_m;
  const double length2 = glm::dot(ds, ds);
  if (length2 > limit2) {
    const double shorter = std::sqrt(limit2 / length2);
    step.da *= shorter;
    step.db *= shorter;
  }
  return step;
}

}  // namespace tangent
