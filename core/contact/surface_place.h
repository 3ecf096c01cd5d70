// A place on the smooth surface where a tangent plane can touch.
//
// Three kinds of place share one form, a SurfaceSample: a point and a normal that depend on two parameters, with
// their derivatives in its _u and _v:
//   face    (u, v): point and normal of the PN patch;
//   edge    (f, turn): the point runs along a crease or boundary edge with f in [0, 1], the normal turns
//           about the edge (edge_fan.h) from the normal of the one side to that of the other; derivatives are
//           along the angle; at a boundary through the half circle to the back of the face. point_v is zero;
//   vertex  the point stands still, the normal turns freely: point_u and point_v are zero, normal_u and
//           normal_v an orthonormal pair.
// At an end of its fan an edge has the point and normal of the face, so contact and normal are continuous where a
// contact leaves a face for an edge, and likewise at the ends of an edge.
#pragma once

#include "core/base/vec.h"
#include "core/mesh/polygon_mesh.h"

#include <cstdint>

namespace tangent {

enum class Feature : std::uint8_t { none, face, edge, vertex };
const char* to_string(Feature feature);

/// A place on the smooth surface. u and v are the barycentric weights on `triangle` (for an edge or vertex they lie on
/// that edge or corner).
struct SurfacePlace {
  Feature feature = Feature::none;
  std::uint8_t side = 0;  ///< edge: which edge of the triangle; vertex: which corner; face: 0, or kWall
  std::uint32_t triangle = kNone;
  double u = 0.0, v = 0.0;
};

/// SurfacePlace::side of a place on a face that is not the finger's own contact with it (tick/walls.h).
inline constexpr std::uint8_t kWall = 1;
inline bool is_wall(const SurfacePlace& place) { return place.feature == Feature::face && place.side == kWall; }

/// Barycentric (u, v) of the point at fraction f of edge k, exactly on the edge.
inline Vec2 edge_point_uv(std::uint32_t edge, double f) {
  switch (edge) {
    case 0:
      return {f, 0.0};
    case 1:
      return {1.0 - f, f};
    default:
      return {0.0, 1.0 - f};
  }
}

/// Barycentric (u, v) of a corner.
inline Vec2 corner_uv(std::uint32_t corner) { return {corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0}; }

/// Fraction f of a point (u, v) on edge k.
inline double edge_fraction(std::uint32_t edge, double u, double v) {
  switch (edge) {
    case 0:
      return u;
    case 1:
      return v;
    default:
      return 1.0 - v;
  }
}

inline SurfacePlace place_on_face(std::uint32_t t, double u, double v) { return {Feature::face, 0, t, u, v}; }

inline SurfacePlace place_on_vertex(std::uint32_t t, std::uint32_t corner) {
  const Vec2 uv = corner_uv(corner);
  return {Feature::vertex, static_cast<std::uint8_t>(corner), t, uv.x, uv.y};
}

inline SurfacePlace place_on_edge(std::uint32_t t, std::uint32_t edge, double f) {
  const Vec2 uv = edge_point_uv(edge, f);
  return {Feature::edge, static_cast<std::uint8_t>(edge), t, uv.x, uv.y};
}

}  // namespace tangent
