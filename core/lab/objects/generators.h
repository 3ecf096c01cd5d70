// The generators behind generate_mesh (private to core/lab/objects). Metres; options are already checked.
#pragma once

#include "core/base/vec.h"
#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

namespace tangent {

// The cylinder that the paper's objects fit in: axis along x, from -kHalfLength to
// +kHalfLength.
inline constexpr double kObjectRadius = 0.040;
inline constexpr double kObjectHalfLength = 0.040;
/// Widest turn of the surface between two rows of a rounded edge.
inline constexpr double kFilletStep = std::numbers::pi / 12.0;

/// Steps that divide a turn of `angle_rad` (0 to pi) so that none is wider than kFilletStep.
int fillet_steps(double angle_rad);

/// A convex polyhedron whose vertices have three faces each.
struct ConvexPolyhedron {
  struct Vertex {
    Vec3 position;                       ///< of the sharp body
    Vec3 outset;                         ///< position - r outset: the vertex with its three faces moved in by r
    std::array<std::uint32_t, 3> faces;  ///< counter-clockwise seen from outside
  };
  std::vector<Vertex> vertices;
  std::vector<std::vector<std::uint32_t>> faces;  ///< vertex loops, counter-clockwise seen from outside
  std::vector<Vec3> face_normals;                 ///< unit, outward
  Vec3 centre{0.0};
  std::vector<double> face_distances;  ///< from the centre; its foot lies well inside the face
  double inradius = 0.0;               ///< of the largest ball inside
};

/// Regular polygon inscribed in the circle of radius kObjectRadius, its first corner `turn_percent` of a
/// corner's share (1/sides of a turn) from +y towards +z, extruded along x.
ConvexPolyhedron make_prism(int sides, int turn_percent, double half_length_m);
/// Base an equilateral triangle inscribed in the circle at -kObjectHalfLength, apex at +kObjectHalfLength.
ConvexPolyhedron make_tetrahedron();

PolygonMesh sharp_polyhedron(const ConvexPolyhedron& body);
/// All edges and corners replaced by cylinders and spheres of radius `rounding_m`, each turn in
/// `steps` steps. The faces stay in their planes, so only pointed corners lose length. Precondition: 0 < rounding_m <
/// inradius.
PolygonMesh rounded_polyhedron(const ConvexPolyhedron& body, double rounding_m, int steps);

/// One ring of a body of revolution about x: every profile point is a circle, or a pole where radius_m is 0.
struct ProfilePoint {
  double x_m = 0.0, radius_m = 0.0;
  Vec2 normal_before{0.0}, normal_after{0.0};  ///< (along x, radial), unit; they differ at a sharp edge
};
/// Profile from the pole at the smaller x to the one at the larger x.
using Profile = std::vector<ProfilePoint>;

PolygonMesh revolve(const Profile& profile, int segments);
Profile sharp_cylinder();
Profile rounded_cylinder(double rounding_m);
Profile sharp_cone();  ///< base at -x, apex at +x
Profile rounded_cone(double rounding_m);
double cylinder_inradius();
double cone_inradius();  ///< of its cross-section through the axis

PolygonMesh make_saddle(int segments);
PolygonMesh make_groove(int segments);

/// Mirrors in the plane x = 0 and reverses faces, so that they stay counter-clockwise from outside.
void mirror_x(PolygonMesh& mesh);

}  // namespace tangent
