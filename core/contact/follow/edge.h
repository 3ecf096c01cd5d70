// The contact on a crease or boundary edge: it slides along the edge's curve while the normal turns within the fan of
// the two sides (contact/edge_fan.h), until the travel draws it into a face or past an end.
#pragma once

#include "core/contact/follow/run.h"

namespace tangent {

/// How the planes of an edge bend around a sample, whatever the finger: of a round one the step along the edge and the
/// stability of a contact follow from it and the height alone.
struct EdgeBend {
  Vec3 along;          ///< N_v x N: in the plane, across the turn
  double speed = 0.0;  ///< S_f . along
  double bend = 0.0;   ///< N_f . along
  double turn2 = 0.0;  ///< |N_v|^2
  /// X_f . along
  double rate(double h) const { return speed + h * bend; }
  /// Along an edge a contact is stable when a step along it moves the plane's contact the same way; across it the fan
  /// is convex, which is stable for a finger outside (h > 0).
  Stability at_height(double h) const {
    const double by_step = speed > 0.0 ? rate(h) : -rate(h), by_turn = h * turn2;
    return {by_step * by_turn, by_step + by_turn};
  }
};
inline EdgeBend edge_bend(const SurfaceSample& s) {
  EdgeBend b;
  b.along = glm::cross(s.normal_v, s.normal);
  b.speed = glm::dot(s.point_u, b.along);
  b.bend = glm::dot(s.normal_u, b.along);
  b.turn2 = glm::dot(s.normal_v, s.normal_v);
  return b;
}
/// Of any finger: for a round one the same as edge_bend's.
inline Stability edge_stability(const SurfaceSample& s, const ContactJacobian& j) {
  const Vec3 along = glm::cross(s.normal_v, s.normal);
  const double rate = glm::dot(j.xa, along), by_step = glm::dot(s.point_u, along) > 0.0 ? rate : -rate;
  const double by_turn = glm::dot(j.xb, s.normal_v);
  return {by_step * by_turn, by_step + by_turn};
}

/// newton_step along an edge for a round finger, of which only the part along f: with S_v = 0 the turn drops out. `d`:
/// centre - S.
inline double round_edge_step(const EdgeBend& bend, double height_m, const Vec3& d) {
  return glm::dot(d, bend.along) / bend.rate(height_m);
}

/// Sample of a plane on an edge, its normal turned to face the finger within the fan. Sets plane.turn.
void sample_edge(ContactContext& context, TrackedPlane& plane, SurfaceSample& sample);
/// The same with the normal that the plane was kept with. Sets plane.turn where that was given from outside.
void sample_kept_edge(ContactContext& context, TrackedPlane& plane, SurfaceSample& sample);

/// Where the contact goes from the edge place `at`: along it, on to the vertex at an end, or off it into a face.
Proposal next_from_edge(ContactContext& context, const TrackedPlane& at, RunMemory& memory, IterationResult& now);

}  // namespace tangent
