// Walls that a finger touches where it would stand, led out of the place that it is in.
//
// A finger pressed deep into an inner edge has come past the end of a wall: seen from where it is the wall holds no
// contact any more, its foot lies beyond the crease. But a god-object, the finger led out of everything that it
// touches, still rests on that wall, and so the wall pushes. It is found from there: what the finger touches that is
// led out of all the known planes is one more, until there is none.
#pragma once

#include "core/contact/decide/decide.h"
#include "core/contact/nearest_triangles.h"
#include "core/contact/touched.h"
#include "core/tick/pushing_planes.h"

namespace tangent {

/// Whether walls can lack: in meshes with inner edges, where a round finger is in a place by over half its radius, or
/// there were walls at the last tick, among those `kept`. `centre`: of the finger. Of other fingers it is not known.
bool can_lack_walls(const ContactMesh& mesh, const Finger& finger, const Vec3& centre, const TrackedPlane& tracked,
                    const TouchedPlaces& kept);

/// A plane that pushes, and whether the finger's centre is behind it.
struct TouchedPlane {
  Vec3 point, normal;
  bool behind = false;
};
inline TouchedPlane touched_plane(const TrackedPlane& plane, const PlaneContact& contact) {
  return {plane.point, plane.normal, !pushes_with_others(contact)};
}

/// Whether a place pushes beside the tracked one. Where the centre is behind either, one pushes alone, as of a thin
/// wall or a sharp edge seen from inside; but `with_walls` not where each lies in front of the other.
inline bool pushes_beside(const TouchedPlane& tracked, const TouchedPlane& other, bool with_walls, double tolerance_m) {
  if (!tracked.behind && !other.behind) return true;
  const Vec3 apart = other.point - tracked.point;
  return with_walls && glm::dot(apart, tracked.normal) >= -tolerance_m && glm::dot(apart, other.normal) <= tolerance_m;
}

/// Whether the centre is behind the tracked place, and that still is the deepest of an inner edge: as seen from inside
/// it would rank after the others (contact_rank.h).
bool is_behind_in_inner_edge(const ContactContext& context, const IterationResult& tracked,
                             const TouchedContacts& touched);

/// Adds to `touched` the walls that it lacks. `kept`, `last`: what was touched at the last tick, and the tracked place.
/// Known walls are followed, and a round finger finds new ones.
void add_walls(ContactContext& context, const NearestTriangles& nearest, const TouchedPlaces& kept,
               const TrackedPlane& last, DecidedContact& decided, TouchedContacts& touched);

/// How deep the finger is in the deepest of the places that were touched, m; 0 where there is none.
double deepest_m(ContactContext& context, const TouchedPlaces& kept, int& evaluations);

/// Where following failed: the deepest of the walls that were touched and hold a contact of the finger's own, if there
/// is one, is gone on with. True where it is.
bool go_on_with_wall(ContactContext& context, const TouchedPlaces& kept, DecidedContact& decided);

}  // namespace tangent
