#include "core/lab/objects/circle_points.h"
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generators.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numbers>
#include <unordered_map>

namespace tangent {
namespace {

struct Icosphere {
  std::vector<Vec3> directions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Icosphere icosahedron() {
  constexpr double g = std::numbers::phi;
  Icosphere body;
  for (const Vec3& corner :
       {Vec3(-1, g, 0), Vec3(1, g, 0), Vec3(-1, -g, 0), Vec3(1, -g, 0), Vec3(0, -1, g), Vec3(0, 1, g), Vec3(0, -1, -g),
        Vec3(0, 1, -g), Vec3(g, 0, -1), Vec3(g, 0, 1), Vec3(-g, 0, -1), Vec3(-g, 0, 1)}) {
    body.directions.push_back(unit(corner));
  }
  body.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return body;
}

void subdivide(Icosphere& body) {
  std::unordered_map<std::uint64_t, std::uint32_t> midpoints;
  const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto [entry, fresh] = midpoints.try_emplace(key, static_cast<std::uint32_t>(body.directions.size()));
    if (fresh) body.directions.push_back(unit(body.directions[a] + body.directions[b]));
    return entry->second;
  };
  std::vector<std::array<std::uint32_t, 3>> finer;
  finer.reserve(4 * body.triangles.size());
  for (const auto& [a, b, c] : body.triangles) {
    const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  body.triangles = std::move(finer);
}

}  // namespace

PolygonMesh make_icosphere(double radius_m, int subdivisions) {
  assert(radius_m > 0.0 && subdivisions >= 0 && subdivisions <= 12);
  Icosphere body = icosahedron();
  for (int i = 0; i < subdivisions; ++i) subdivide(body);
  PolygonMesh mesh;
  mesh.name = "icosphere";
  mesh.positions.reserve(body.directions.size());
  for (const Vec3& direction : body.directions) mesh.positions.push_back(radius_m * direction);
  mesh.normals = std::move(body.directions);
  for (const auto& [a, b, c] : body.triangles) mesh.add_face({a, b, c});
  mesh.corner_normal = mesh.corner_position;
  return mesh;
}

// Ring in the x-y plane, axis z. Two triangles to a quad, split along the same diagonal.
PolygonMesh make_torus(double ring_radius_m, double tube_radius_m, int ring_segments, int tube_segments) {
  assert(tube_radius_m > 0.0 && ring_radius_m > tube_radius_m && ring_segments >= 3 && tube_segments >= 3);
  PolygonMesh mesh;
  mesh.name = "torus";
  for (int i = 0; i < ring_segments; ++i) {
    const Vec2 around = circle_point(i, ring_segments);
    for (int j = 0; j < tube_segments; ++j) {
      const Vec2 tube = circle_point(j, tube_segments);
      const double radius = ring_radius_m + tube_radius_m * tube.x;
      mesh.positions.push_back({radius * around.x, radius * around.y, tube_radius_m * tube.y});
      mesh.normals.push_back({tube.x * around.x, tube.x * around.y, tube.y});
    }
  }
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % ring_segments) * tube_segments + j % tube_segments);
  };
  for (int i = 0; i < ring_segments; ++i) {
    for (int j = 0; j < tube_segments; ++j) {
      mesh.add_face({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.add_face({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  mesh.corner_normal = mesh.corner_position;
  return mesh;
}

}  // namespace tangent
