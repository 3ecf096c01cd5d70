// The fan of normals about a point of a crease or boundary edge.
#pragma once

#include "core/contact/finger.h"
#include "core/surface/pn_patch.h"

namespace tangent {

/// The frame of a crease or boundary edge at one point of it.
struct EdgeFan {
  Vec3 point, point_f;          ///< on the edge curve; derivative along f
  Vec3 tangent;                 ///< unit
  Vec3 e1, e2;                  ///< perpendicular to the tangent; e1 along the near side's normal, e2 away from its face
  double tilt_near = 0.0, tilt_far = 0.0;  ///< normal . tangent on the two sides
  double fan = 0.0;             ///< angle from the near normal to the far one, rad; positive: convex
  Vec3 near_normal, far_normal;            ///< unit normals of the two sides
  Vec3 near_normal_f, far_normal_f;        ///< their derivatives along f
  Vec3 tangent_f;                          ///< derivative of the unit tangent along f
};

class PatchCache;

/// f runs from corner `edge` to corner `edge + 1` of triangle t. Precondition: not a smooth edge. The cache holds it:
/// the reference is good until the next call.
const EdgeFan& edge_fan(PatchCache& cache, std::uint32_t t, std::uint32_t edge, double f, NormalForm form);

/// Unit normal of the fan at angle `turn`, its derivative along the turn and along f. The latter is interpolated
/// between the sides, but for its part along the edge, N_f.T = tilt_f - N.T_f, which is exact.
struct FanNormal {
  Vec3 normal, by_turn, by_f;
};
FanNormal fan_normal(const EdgeFan& fan, double turn);

/// The turn at which the plane faces the finger: the travel has no component across the edge. Not limited
/// to [0, fan]; in (-pi, pi].
double facing_turn(const EdgeFan& fan, const Finger& finger, const FingerPose& pose);

}  // namespace tangent
