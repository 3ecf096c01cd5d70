// A cylinder whose flat caps are polygons of n corners, as CAD programs write them: fans of n - 2 slivers about one
// corner of the rim.
#pragma once

#include "core/mesh/polygon_mesh.h"

#include <cmath>

namespace tangent::test {

/// Of 40 mm radius, with its caps at +-20 mm along z.
inline PolygonMesh capped_cylinder(int n) {
  PolygonMesh mesh;
  for (const double z : {-0.020, 0.020})
    for (int i = 0; i < n; ++i) {
      const double turn = 6.283185307179586 * i / n;
      mesh.positions.push_back({0.040 * std::cos(turn), 0.040 * std::sin(turn), z});
    }
  const auto corner = [&](int i) { mesh.corner_position.push_back(static_cast<std::uint32_t>(i)); };
  const auto close = [&] { mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corner_position.size())); };
  for (int i = 0; i < n; ++i) corner(n + i);
  close();
  for (int i = n; i-- > 0;) corner(i);
  close();
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    corner(i), corner(j), corner(n + j), corner(n + i);
    close();
  }
  return mesh;
}

}  // namespace tangent::test
