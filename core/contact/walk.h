// Walking on the flat triangles: a step in the plane of one triangle goes on in its neighbours, unfolded
// about the edges it crosses, until it ends inside a triangle or at a crease or boundary edge.
#pragma once

#include "core/contact/place.h"

namespace tangent {

/// True where (u, v) + (du, dv) stays inside the triangle; most steps do.
inline bool stays_inside(double u, double v, double du, double dv) {
  const double to_u = u + du, to_v = v + dv;
  return to_u >= 0.0 && to_v >= 0.0 && to_u + to_v <= 1.0;
}

struct WalkResult {
  TrackedPlane place;             ///< feature face, or edge where a crease or boundary stopped it (point, normal unset)
  int triangle_changes = 0;
  bool lost = false;              ///< gave up: too many crossings or a degenerate triangle in the way
};

/// From (u, v) on triangle t by (du, dv) in that triangle's barycentric frame. Concave creases are crossed
/// like smooth edges: no finger rests on one.
WalkResult walk_face(const ContactMesh& mesh, std::uint32_t t, double u, double v, double du, double dv);

/// True where the far side of crease edge k rises above the near side's tangent planes.
bool concave_crease(const ContactMesh& mesh, std::uint32_t t, std::uint32_t edge);

/// (du, dv) of the in-plane part of `vector` in the frame of triangle t. False where the triangle has no area.
bool to_barycentric(const ContactMesh& mesh, std::uint32_t t, const Vec3& vector, double& du, double& dv);

}  // namespace tangent
