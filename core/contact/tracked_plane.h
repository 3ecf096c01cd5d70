// The tangent plane that a tick keeps for the next one.
#pragma once

#include "core/contact/surface_place.h"

namespace tangent {

/// Where the tangent plane touches the smooth surface. The normal belongs to the place for faces; on edges and vertices
/// it turns within the fan.
struct TrackedPlane : SurfacePlace {
  Vec3 point{0.0};             ///< S, local mesh coordinates, m
  Vec3 normal{0.0, 0.0, 1.0};  ///< N, unit
  Vec2 turn{1.0, 0.0};         ///< edge: direction of N about the edge (edge_fan.h); else unused

  /// Point and normal there are still to be computed.
  void move_to(const SurfacePlace& place) { static_cast<SurfacePlace&>(*this) = place; }
};

}  // namespace tangent
