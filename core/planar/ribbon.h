// A 2D scene seen in space.
#pragma once

#include "core/mesh/polygon_mesh.h"
#include "core/planar/curve.h"

namespace tangent {

/// A ribbon along the polygon, extruded by `half_width_m` to either side of z = 0, for views of the scene.
PolygonMesh ribbon(const PlanarCurve& curve, double half_width_m);

}  // namespace tangent
