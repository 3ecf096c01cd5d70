// Invariants of every contact mesh, whatever its input. For tests.
#pragma once

#include "core/base/tolerances.h"
#include "core/mesh/contact_mesh.h"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

namespace tangent::sample {

using Indices = std::vector<std::uint64_t>;

inline ContactMesh build(const PolygonMesh& source, const ContactMeshOptions& options = {}) {
  auto built = ContactMesh::build(source, options);
  if (!built) FAIL(built.error().message());
  return std::move(*built);
}

inline ContactMeshOptions computed(double crease_deg = 45.0) {
  ContactMeshOptions o;
  o.normals = NormalSource::computed;
  o.crease_rad = crease_deg * kDegree;
  return o;
}

inline void check_defects(const ContactMesh& m, MeshDefect kind, const Indices& expected) {
  CAPTURE(std::string(to_string(kind)));
  CHECK(m.defects(kind).count == expected.size());
  CHECK(m.defects(kind).first == expected);
}

inline std::uint32_t count_boundary(const ContactMesh& m) {
  std::uint32_t n = 0;
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) n += m.usable(t) && m.edge_kind(t, k) == EdgeKind::boundary;
  return n;
}

inline void check_sound(const ContactMesh& m) {
  std::uint32_t usable = 0, wrong_links = 0, wrong_bits = 0, wrong_normals = 0, wrong_positions = 0;
  std::vector<bool> feature(m.vertex_count(), false);
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t) {
    if (!m.usable(t)) continue;
    ++usable;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t k1 = (k + 1) % 3;
      wrong_positions += !is_finite(m.position(t, k)) || m.position(t, k) == m.position(t, k1);
      wrong_normals += !(std::abs(glm::length(m.normal(t, k)) - 1.0) < 1e-14);
      const EdgeLink n = m.across(t, k);
      if (m.edge_kind(t, k) != EdgeKind::smooth) feature[m.vertex(t, k)] = feature[m.vertex(t, k1)] = true;
      if (n.triangle == kNone) continue;
      const EdgeLink back = m.across(n.triangle, n.edge);
      const std::uint32_t f = n.edge, f1 = (n.edge + 1) % 3;
      wrong_links += back.triangle != t || back.edge != k || n.triangle == t || !m.usable(n.triangle) ||
                     m.vertex(n.triangle, f) != m.vertex(t, k1) || m.vertex(n.triangle, f1) != m.vertex(t, k);
      wrong_bits += m.edge_kind(t, k) != m.edge_kind(n.triangle, f);
      const bool differ = glm::length(m.normal(t, k) - m.normal(n.triangle, f1)) > kSameNormal ||
                          glm::length(m.normal(t, k1) - m.normal(n.triangle, f)) > kSameNormal;
      wrong_bits += differ != (m.edge_kind(t, k) == EdgeKind::crease);
    }
  }
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t) {
    if (!m.usable(t)) continue;
    bool any = false;
    for (std::uint32_t k = 0; k < 3; ++k) {
      wrong_bits += m.feature_corner(t, k) != feature[m.vertex(t, k)];
      any = any || feature[m.vertex(t, k)];
    }
    wrong_bits += m.interior(t) == any;
  }
  CHECK(usable == m.usable_triangle_count());
  CHECK(wrong_links == 0);
  CHECK(wrong_bits == 0);
  CHECK(wrong_normals == 0);
  CHECK(wrong_positions == 0);
}

/// The corners at each vertex must form one fan: a walk over links reaches all of them.
inline void check_one_fan_per_vertex(const ContactMesh& m) {
  std::vector<std::uint32_t> corners(m.vertex_count(), 0), walked(m.vertex_count(), 0);
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t) {
    if (!m.usable(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = m.vertex(t, k);
      if (corners[v]++ > 0) continue;
      std::set<std::uint32_t> reached{t};
      for (const bool left : {true, false}) {
        std::uint32_t at = t, corner = k;
        while (true) {
          const EdgeLink n = m.across(at, left ? (corner + 2) % 3 : corner);
          if (n.triangle == kNone || n.triangle == t) break;
          reached.insert(at = n.triangle);
          corner = left ? n.edge : (n.edge + 1) % 3;
          REQUIRE(m.vertex(at, corner) == v);
        }
      }
      walked[v] = static_cast<std::uint32_t>(reached.size());
    }
  }
  CHECK(corners == walked);
}

}  // namespace tangent::sample
