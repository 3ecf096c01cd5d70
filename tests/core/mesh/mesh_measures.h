// Measures of a polygon mesh with corner normals, for tests.
#pragma once

#include "core/base/vec.h"
#include "core/mesh/polygon_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace tangent::testing {

/// Calls visit({corner, corner, corner}) for every triangle of every face's fan.
template <class Visit>
void for_each_triangle(const PolygonMesh& mesh, Visit visit) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t first = mesh.face_offsets[f];
    for (std::uint32_t k = first + 2; k < mesh.face_offsets[f + 1]; ++k) {
      visit(std::array<std::uint32_t, 3>{first, k - 1, k});
    }
  }
}

struct Topology {
  std::size_t edges = 0, open_edges = 0;
  bool edges_used_once = true;  ///< no edge is used twice in the same direction
};

inline Topology topology_of(const PolygonMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> walked;
  Topology topology;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      if (!walked.emplace(face[k], face[(k + 1) % face.size()]).second) topology.edges_used_once = false;
    }
  }
  for (const auto& [a, b] : walked) {
    const bool paired = walked.contains({b, a});
    topology.open_edges += paired ? 0 : 1;
    topology.edges += !paired || a < b ? 1 : 0;
  }
  return topology;
}

inline long euler_characteristic(const PolygonMesh& mesh) {
  return static_cast<long>(mesh.positions.size()) - static_cast<long>(topology_of(mesh).edges) +
         static_cast<long>(mesh.face_count());
}

inline double volume_of(const PolygonMesh& mesh) {
  double volume = 0.0;
  const auto p = [&](std::uint32_t corner) { return mesh.positions[mesh.corner_position[corner]]; };
  for_each_triangle(mesh, [&](const auto& t) { volume += glm::dot(p(t[0]), glm::cross(p(t[1]), p(t[2]))) / 6.0; });
  return volume;
}

inline Box bounds_of(const PolygonMesh& mesh) {
  Box box;
  for (const Vec3& p : mesh.positions) box.include(p);
  return box;
}

/// Largest angle between a corner's normal and its triangle's, and of a normal's length from 1.
struct NormalHealth {
  double worst_angle_rad = 0.0, worst_length = 0.0;
};

inline NormalHealth normal_health(const PolygonMesh& mesh) {
  NormalHealth health;
  for (const Vec3& n : mesh.normals)
    health.worst_length = std::max(health.worst_length, std::abs(glm::length(n) - 1.0));
  for_each_triangle(mesh, [&](const auto& t) {
    const auto p = [&](int k) { return mesh.positions[mesh.corner_position[t[k]]]; };
    const Vec3 across = unit(glm::cross(p(1) - p(0), p(2) - p(0)));
    for (const std::uint32_t corner : t) {
      const Vec3& n = mesh.normals[mesh.corner_normal[corner]];
      health.worst_angle_rad = std::max(health.worst_angle_rad, std::acos(std::min(1.0, glm::dot(n, across))));
    }
  });
  return health;
}

/// Edges at whose ends the two faces' normals differ.
inline std::size_t crease_count(const PolygonMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<Vec3, Vec3>> walked;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t begin = mesh.face_offsets[f], end = mesh.face_offsets[f + 1];
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t next = k + 1 == end ? begin : k + 1;
      walked[{mesh.corner_position[k], mesh.corner_position[next]}] = {mesh.normals[mesh.corner_normal[k]],
                                                                       mesh.normals[mesh.corner_normal[next]]};
    }
  }
  std::size_t creases = 0;
  for (const auto& [edge, normals] : walked) {
    const auto back = walked.find({edge.second, edge.first});
    if (back == walked.end() || edge.first > edge.second) continue;
    if (back->second.first != normals.second || back->second.second != normals.first) ++creases;
  }
  return creases;
}

using Coordinates = std::tuple<double, double, double>;

/// All vertices with coordinates multiplied by these signs, sorted by value.
inline std::vector<Coordinates> sorted_positions(const PolygonMesh& mesh, const Vec3& signs) {
  std::vector<Coordinates> list;
  for (const Vec3& p : mesh.positions) list.emplace_back(signs.x * p.x + 0.0, signs.y * p.y + 0.0, signs.z * p.z + 0.0);
  std::sort(list.begin(), list.end());
  return list;
}

}  // namespace tangent::testing
