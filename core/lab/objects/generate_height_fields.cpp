#include "core/lab/objects/generators.h"
#include "core/lab/objects/mesh_assembly.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr double kHalfPlate = 0.040;  // m; both plates are 80 mm square

struct Height {
  double z_m, slope_x, slope_y;
};

/// A grid over the square, normals straight from the slopes. Lines lie exactly symmetric about the axes.
template <class HeightAt>
PolygonMesh height_field(int columns, int rows, HeightAt height_at) {
  const auto line = [](int i, int count) { return kHalfPlate * static_cast<double>(2 * i - count) / count; };
  MeshAssembly assembly;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double x = line(i, columns), y = line(j, rows);
      const Height h = height_at(x, y);
      assembly.add_point({x, y, h.z_m}, unit({-h.slope_x, -h.slope_y, 1.0}));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      assembly.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      assembly.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return std::move(assembly.mesh);
}

}  // namespace

// z = (x^2 - y^2)/(2 radius): principal curvatures +-1/radius at the centre, 20 mm up and down at the
// sides' middles. A 20 mm finger stays in single contact everywhere.
PolygonMesh make_saddle(int segments) {
  constexpr double kRadius = 0.040;
  return height_field(segments, segments, [](double x, double y) {
    return Height{(x * x - y * y) / (2.0 * kRadius), x / kRadius, -y / kRadius};
  });
}

// A valley along y: z = -depth/2 (1 + cos(2 pi x / width)) for |x| < width/2, 0 outside. Radius of
// curvature 2 (width/2 pi)^2 / depth = 5.7 mm at the bottom (concave) and at the shoulders, so a 20 mm
// finger in it rests on both walls.
PolygonMesh make_groove(int segments) {
  constexpr double kWidth = 0.030, kDepth = 0.008;
  const int rows = std::max(1, segments / 4);  // straight along y
  return height_field(segments, rows, [](double x, double) {
    if (std::abs(x) >= 0.5 * kWidth) return Height{0.0, 0.0, 0.0};
    constexpr double kWave = 2.0 * std::numbers::pi / kWidth;
    return Height{-0.5 * kDepth * (1.0 + std::cos(kWave * x)), 0.5 * kDepth * kWave * std::sin(kWave * x), 0.0};
  });
}

}  // namespace tangent
