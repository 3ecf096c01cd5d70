// The generators behind the hard meshes (private to core/lab/objects). Metres, about 80 mm across.
#pragma once

#include "core/mesh/polygon_mesh.h"

#include <cstdint>
#include <vector>

namespace tangent {

/// A point of a profile in the x-z plane.
struct SheetLine {
  double x_m = 0.0, z_m = 0.0;
};

/// The profile swept along y over [-40, 40] mm in `rows` rows, facing up where x grows; normals are computed.
PolygonMesh swept_sheet(const std::vector<SheetLine>& profile, int rows);

/// z = height(x, y) over a square of side 2 half_m, cells x cells squares; normals are computed.
template <class Height>
PolygonMesh height_sheet(double half_m, int cells, Height height) {
  PolygonMesh mesh;
  const auto line = [&](int i) { return half_m * static_cast<double>(2 * i - cells) / cells; };
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) mesh.positions.emplace_back(line(i), line(j), height(line(i), line(j)));
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      mesh.add_face({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.add_face({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

// Shapes (generate_hard_shapes.cpp).
PolygonMesh make_trough();
PolygonMesh make_exact_pipe();
PolygonMesh make_dimple();
PolygonMesh make_two_plates();
PolygonMesh make_thin_fin();
PolygonMesh make_needle_arch();
PolygonMesh make_sliver_pole_sphere();
PolygonMesh make_open_bowl();
PolygonMesh make_narrow_cup();
PolygonMesh make_moebius();
PolygonMesh make_crease_dart();
PolygonMesh make_notched_cube();
PolygonMesh make_staircase();

// Bodies with defects in the file (generate_hard_defects.cpp).
PolygonMesh make_zero_normals();
PolygonMesh make_flipped_normals();
PolygonMesh make_mixed_orientation();
PolygonMesh make_triangle_soup();
PolygonMesh make_duplicate_faces();
PolygonMesh make_degenerate_faces();
PolygonMesh make_fin_on_plate();
PolygonMesh make_noisy_sphere();

}  // namespace tangent
