// The plane through a given point that the finger touches just there: what a contact on a vertex shows, and a contact
// where the surface's own normals offer none.
#pragma once

#include "core/finger/finger.h"

namespace tangent {

/// From which side of its plane the finger's centre shall be seen.
enum class FacingSide : std::uint8_t {
  front,  ///< the plane between point and finger as far as they are apart: the finger's point nearest to `point`
  back,   ///< the centre under the plane: the finger's furthest point, as from inside a solid
};

/// Unit normal N of the plane through `point` whose contact with the finger is `point`: p(N) + penetration N = point.
/// +-unit(c - point) for a round finger; for others the least (front) or largest (back) penetration over all N near
/// `start`, a unit vector, which also stands in where the centre is the point. `pose` and `point` in the same frame.
Vec3 facing_normal(const Finger& finger, const FingerPose& pose, const Vec3& point, const Vec3& start,
                   FacingSide side = FacingSide::front);

/// With `d` from a point to a capsule's centre and `half` half its axis: from the point to the place centre + along *
/// half on the axis, leaning as a normal does that belongs to that place. A normal's core point is g half off the
/// centre where it leans by -w g / (L sqrt(1 - g^2)) towards `half`, w half the core's width and L = |half|. `along`:
/// any number; beyond an end counts as the end.
Vec3 towards_axis(const Vec3& d, const Vec3& half, double along);

}  // namespace tangent
