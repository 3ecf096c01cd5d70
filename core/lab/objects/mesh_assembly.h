// Assembles a mesh corner by corner (private to the generators).
#pragma once

#include "core/mesh/polygon_mesh.h"

#include <cstdint>
#include <initializer_list>

namespace tangent {

struct MeshAssembly {
  /// A corner of a face: which position, which normal.
  struct Corner {
    std::uint32_t position, normal;
  };

  PolygonMesh mesh;

  std::uint32_t add_position(const Vec3& p) {
    mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
  std::uint32_t add_normal(const Vec3& n) {
    mesh.normals.push_back(n);
    return static_cast<std::uint32_t>(mesh.normals.size() - 1);
  }
  /// A point of a smooth surface: the position and its one normal, under the same number.
  /// Precondition: nothing was added otherwise.
  std::uint32_t add_point(const Vec3& p, const Vec3& n) {
    add_normal(n);
    return add_position(p);
  }

  void add_corner(const Corner& corner) {
    mesh.corner_position.push_back(corner.position);
    mesh.corner_normal.push_back(corner.normal);
  }
  void close_face() { mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corner_position.size())); }

  void add_face(std::initializer_list<Corner> corners) {
    for (const Corner& corner : corners) add_corner(corner);
    close_face();
  }
  /// A triangle between points made by `add_point`.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { add_face({{a, a}, {b, b}, {c, c}}); }
};

}  // namespace tangent
