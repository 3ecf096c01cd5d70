// Generated meshes: the paper's objects and test bodies. Metres, outward normals,
// faces counter-clockwise seen from outside. Deterministic.
#pragma once

#include "core/base/result.h"
#include "core/mesh/polygon_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace tangent {

enum class Facing { left, right };  ///< where the apex of cone and tetrahedron points along x: left is -x

struct GenerateOptions {
  /// Segments around cone, cylinder, torus; subdivisions of sphere and icosphere; grid lines of saddle and groove;
  /// of flat-faced objects the steps across a rounded edge. 0: the object's default.
  int segments = 0;
  /// Radius of the rounded edges; 0: sharp, with split normals at the edges. Faces stay in their planes, so that the
  /// outer dimensions are unchanged, except at pointed tips. At most 0.9 of the inradius.
  double rounding_m = 0.0;
  Facing facing = Facing::right;
};

/// cone cylinder cube sphere tetrahedron octagon triangle hexagon (paper; axis along x, inside a cylinder
/// of radius 40 mm, length 80 mm) and icosphere torus saddle groove.
const std::vector<std::string>& generator_names();

/// Also takes the names of the hard meshes (generate_hard.h). Fails on an unknown name or an option out of range,
/// naming the choices or the range.
Result<PolygonMesh> generate_mesh(std::string_view name, const GenerateOptions& options = {});

PolygonMesh make_icosphere(double radius_m, int subdivisions);  ///< 20 * 4^subdivisions triangles
PolygonMesh make_torus(double ring_radius_m, double tube_radius_m, int ring_segments, int tube_segments);

}  // namespace tangent
