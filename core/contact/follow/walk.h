// Walking on the flat triangles: a step in the plane of one triangle goes on in its neighbours, unfolded
// about the edges it crosses, until it ends inside a triangle or at a crease or boundary edge.
#pragma once

#include "core/contact/surface_place.h"
#include "core/mesh/contact_mesh.h"

#include <optional>

namespace tangent {

/// True where (u, v) + (du, dv) stays inside the triangle; most steps do.
inline bool stays_inside(double u, double v, double du, double dv) {
  const double to_u = u + du, to_v = v + dv;
  return to_u >= 0.0 && to_v >= 0.0 && to_u + to_v <= 1.0;
}

struct WalkResult {
  SurfacePlace place;  ///< feature face, or edge where a crease or boundary stopped it
  int triangle_changes = 0;
  bool lost = false;  ///< gave up: too many crossings or a degenerate triangle in the way
};

/// From (u, v) on triangle t by (du, dv) in that triangle's barycentric frame. Concave creases are crossed
/// like smooth edges: no finger rests on one. Lost where it crosses more edges than `most_crossings`.
WalkResult walk_face(const ContactMesh& mesh, std::uint32_t t, double u, double v, double du, double dv,
                     int most_crossings);

/// Past the end of a crease or boundary edge k of t (`forwards`: corner k + 1) by `beyond_m`, along the only other such
/// edge there; no further than its other end. Nothing where the edge ends, branches or bends by over 30 degrees.
std::optional<SurfacePlace> walk_past_end(const ContactMesh& mesh, std::uint32_t t, std::uint32_t edge, bool forwards,
                                          double beyond_m);

/// (du, dv) of the in-plane part of `vector` in the frame of triangle t. False where the triangle has no area.
bool to_barycentric(const ContactMesh& mesh, std::uint32_t t, const Vec3& vector, double& du, double& dv);

}  // namespace tangent
