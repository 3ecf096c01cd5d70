// A place on the smooth surface where a tangent plane can touch, with what a solver step needs there.
//
// Three kinds of place share one form, a point and a normal that depend on two parameters (a, b):
//   face    (u, v): point and normal of the PN patch;
//   edge    (f, turn): the point runs along a crease or boundary edge with f in [0, 1], the normal turns
//           by the angle `turn` about the edge from the normal of the one side (0) to that of the other
//           (`fan`); at a boundary through the half circle to the back of the face;
//   vertex  the point stands still, the normal turns freely.
// At turn = 0 an edge has the point and normal of the face, so contact and normal are continuous where a
// contact leaves a face for an edge, and likewise at the ends of an edge.
#pragma once

#include "core/contact/patch_cache.h"
#include "core/contact/plane_contact.h"
#include "core/step.h"

namespace tangent {

/// Point, normal and derivatives at a place. For faces a = u, b = v; for edges a = f, b = turn (point_b is
/// zero); for vertices the point derivatives are zero and the normal's are an orthonormal pair.
struct PlaceSample {
  Vec3 point, point_a, point_b;
  Vec3 normal, normal_a, normal_b;
};

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

/// f runs from corner `edge` to corner `edge + 1` of triangle t. Precondition: not a smooth edge.
EdgeFan edge_fan(PatchCache& cache, std::uint32_t t, std::uint32_t edge, double f, NormalForm form);

/// Unit normal of the fan at angle `turn`, its derivative along the turn and along f. The latter is interpolated
/// between the sides, but for its part along the edge, N_f.T = tilt_f - N.T_f, which is exact.
struct FanNormal {
  Vec3 normal, by_turn, by_f;
};
FanNormal fan_normal(const EdgeFan& fan, double turn);

/// The turn at which the plane faces the finger: the travel has no component across the edge. Not limited
/// to [0, fan]; in (-pi, pi].
double facing_turn(const EdgeFan& fan, const Finger& finger, const FingerPose& pose);

/// Barycentric (u, v) of the point at fraction f of edge k, exactly on the edge.
Vec2 edge_point_uv(std::uint32_t edge, double f);
/// Fraction f of a point (u, v) on edge k.
double edge_fraction(std::uint32_t edge, double u, double v);

}  // namespace tangent
