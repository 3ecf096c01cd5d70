// Meshes whose creases are straight, and ones whose creases curve between sides whose normals turn along them.
#pragma once

#include "tests/core/scenes.h"

#include <vector>

namespace tangent::test {

inline std::vector<ContactMesh> creased_meshes() {
  std::vector<ContactMesh> meshes;
  const auto add = [&](PolygonMesh mesh, double crease_deg) {
    mesh.normals.clear();
    mesh.corner_normal.clear();
    ContactMeshOptions options;
    options.crease_rad = crease_deg * kDegree;
    meshes.push_back(*ContactMesh::build(mesh, options));
  };
  for (const char* name : {"cube", "cylinder", "octagon", "tetrahedron"}) add(*generate_mesh(name), 40.0);
  PolygonMesh stone = make_icosphere(0.030, 1);
  Random random(310);
  for (Vec3& p : stone.positions) p *= random.in(0.8, 1.2);
  for (const double crease_deg : {5.0, 20.0, 35.0}) add(stone, crease_deg);
  return meshes;
}

}  // namespace tangent::test
