// Small meshes with known topology for the tests of the mesh room. Metres.
#pragma once

#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace tangent::sample {

inline PolygonMesh mesh(std::vector<Vec3> positions, const std::vector<std::vector<std::uint32_t>>& faces) {
  PolygonMesh m;
  m.name = "sample";
  m.positions = std::move(positions);
  for (const auto& face : faces) {
    m.corner_position.insert(m.corner_position.end(), face.begin(), face.end());
    m.face_offsets.push_back(static_cast<std::uint32_t>(m.corner_position.size()));
  }
  return m;
}

/// Cube of edge 2 s about the origin, six outward quads.
inline PolygonMesh cube(double s = 1.0) {
  std::vector<Vec3> p;
  for (int i = 0; i < 8; ++i) p.push_back(Vec3(i & 1 ? s : -s, i & 2 ? s : -s, i & 4 ? s : -s));
  return mesh(p, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

/// Every corner gets its own vertex, as in STL.
inline PolygonMesh unwelded(const PolygonMesh& m) {
  PolygonMesh r = m;
  r.positions.clear();
  for (std::size_t i = 0; i < m.corner_position.size(); ++i) {
    r.positions.push_back(m.positions[m.corner_position[i]]);
    r.corner_position[i] = static_cast<std::uint32_t>(i);
  }
  return r;
}

inline PolygonMesh moved(PolygonMesh m, double scale, Vec3 by = Vec3(0.0)) {
  for (Vec3& p : m.positions) p = p * scale + by;
  return m;
}

/// Height field z = f(x, y) over n x n squares of edge 1 about the origin, two triangles each.
template <class Height>
PolygonMesh grid(int n, Height f) {
  std::vector<Vec3> p;
  std::vector<std::vector<std::uint32_t>> faces;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const double px = x - 0.5 * n, py = y - 0.5 * n;
      p.push_back(Vec3(px, py, f(px, py)));
    }
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const auto i = static_cast<std::uint32_t>(y * (n + 1) + x), up = i + static_cast<std::uint32_t>(n) + 1;
      faces.push_back({i, i + 1, up + 1});
      faces.push_back({i, up + 1, up});
    }
  return mesh(std::move(p), faces);
}

/// Band of 2 n triangles about the z axis, turned half round once: one-sided.
inline PolygonMesh moebius(int n) {
  std::vector<Vec3> p;
  std::vector<std::vector<std::uint32_t>> faces;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * 3.14159265358979 * i / n;
    for (const double s : {-0.3, 0.3})
      p.push_back(
          Vec3((1 + s * std::cos(a / 2)) * std::cos(a), (1 + s * std::cos(a / 2)) * std::sin(a), s * std::sin(a / 2)));
  }
  const auto count = static_cast<std::uint32_t>(2 * n);
  for (std::uint32_t i = 0; i < count; i += 2) {
    const bool last = i + 2 == count;  // the ends meet crosswise
    const std::uint32_t c = last ? 1 : i + 2, d = last ? 0 : i + 3;
    faces.push_back({i, c, d});
    faces.push_back({i, d, i + 1});
  }
  return mesh(std::move(p), faces);
}

/// Random triangles over few vertices, with every kind of defect.
inline PolygonMesh soup(std::uint32_t seed, int vertices, int faces) {
  std::mt19937 random(seed);
  PolygonMesh m;
  m.name = "soup";
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<std::uint32_t>(n)); };
  for (int i = 0; i < vertices; ++i)
    m.positions.push_back(Vec3(pick(4), pick(4), pick(4)));  // a coarse lattice: equal and collinear ones abound
  if (pick(4) == 0) m.positions[0].x = std::nan("");
  for (int f = 0; f < faces; ++f) {
    const int corners = pick(8) == 0 ? pick(7) : 3;
    for (int k = 0; k < corners; ++k) m.corner_position.push_back(static_cast<std::uint32_t>(pick(vertices)));
    m.face_offsets.push_back(static_cast<std::uint32_t>(m.corner_position.size()));
  }
  return m;
}

}  // namespace tangent::sample
