// Hard because of defects in the file: normals, orientation, shared and repeated elements, impossible faces.
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generators_hard.h"

#include <cstdint>
#include <limits>

namespace tangent {
namespace {

/// 1,280 triangles.
PolygonMesh sphere() { return make_icosphere(0.040, 3); }

PolygonMesh sphere_without_normals() {
  PolygonMesh mesh = sphere();
  mesh.normals.clear();
  mesh.corner_normal.clear();
  return mesh;
}

/// Noise in [-1, 1], the same on every platform (splitmix64).
double noise(std::uint64_t i) {
  std::uint64_t z = (i + 1) * 0x9E3779B97F4A7C15ull;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

}  // namespace

PolygonMesh make_zero_normals() {
  PolygonMesh mesh = sphere();
  for (std::size_t i = 0; i < mesh.normals.size(); i += 3) {
    mesh.normals[i] = i % 2 == 0 ? Vec3(0.0) : Vec3(std::numeric_limits<double>::quiet_NaN());
  }
  return mesh;
}

PolygonMesh make_flipped_normals() {
  PolygonMesh mesh = sphere();
  for (Vec3& n : mesh.normals) n = -n;
  return mesh;
}

PolygonMesh make_mixed_orientation() {
  PolygonMesh mesh = sphere_without_normals();
  for (std::size_t f = 0; f < mesh.face_count(); f += 3) {
    std::swap(mesh.corner_position[3 * f + 1], mesh.corner_position[3 * f + 2]);
  }
  return mesh;
}

PolygonMesh make_triangle_soup() {
  const PolygonMesh shared = sphere_without_normals();
  PolygonMesh mesh;
  for (const std::uint32_t corner : shared.corner_position) mesh.positions.push_back(shared.positions[corner]);
  for (std::uint32_t i = 0; i < mesh.positions.size(); i += 3) mesh.add_face({i, i + 1, i + 2});
  return mesh;
}

PolygonMesh make_duplicate_faces() {
  PolygonMesh mesh = sphere_without_normals();
  const std::size_t faces = mesh.face_count();
  for (std::size_t f = 0; f < faces; f += 5) {
    const std::uint32_t a = mesh.corner_position[3 * f], b = mesh.corner_position[3 * f + 1],
                        c = mesh.corner_position[3 * f + 2];
    if (f % 2 == 0) {
      mesh.add_face({b, c, a});
    } else {
      mesh.add_face({a, c, b});
    }
  }
  return mesh;
}

// Repeated corners, three corners in line, faces of two corners: each beside every eighth face.
PolygonMesh make_degenerate_faces() {
  const PolygonMesh good = sphere_without_normals();
  PolygonMesh mesh;
  mesh.positions = good.positions;
  for (std::size_t f = 0; f < good.face_count(); ++f) {
    const std::uint32_t a = good.corner_position[3 * f], b = good.corner_position[3 * f + 1],
                        c = good.corner_position[3 * f + 2];
    mesh.add_face({a, b, c});
    if (f % 8 != 0) continue;
    mesh.add_face({a, a, b});
    mesh.add_face({b, c});
    mesh.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
    mesh.add_face({a, static_cast<std::uint32_t>(mesh.positions.size() - 1), b});
  }
  return mesh;
}

// A plate with a fin that stands on a line of its edges.
PolygonMesh make_fin_on_plate() {
  constexpr int kCells = 16;
  PolygonMesh mesh = height_sheet(0.040, kCells, [](double, double) { return 0.0; });
  const auto foot = [](int i) { return static_cast<std::uint32_t>(kCells / 2 * (kCells + 1) + i); };
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i <= kCells; ++i) mesh.positions.push_back(mesh.positions[foot(i)] + Vec3(0.0, 0.0, 0.010));
  for (int i = 0; i < kCells; ++i) {
    const auto top = first + static_cast<std::uint32_t>(i);
    mesh.add_face({foot(i), foot(i + 1), top + 1});
    mesh.add_face({foot(i), top + 1, top});
  }
  return mesh;
}

PolygonMesh make_noisy_sphere() {
  PolygonMesh mesh = make_icosphere(0.040, 4);
  mesh.normals.clear();
  mesh.corner_normal.clear();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] *= 1.0 + 0.3e-3 / 0.040 * noise(i);
  return mesh;
}

}  // namespace tangent
