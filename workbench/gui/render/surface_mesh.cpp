#include "workbench/gui/render/surface_mesh.h"

#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

std::array<float, 3> to_float(const Vec3& p, double scale_m) {
  return {static_cast<float>(p.x / scale_m), static_cast<float>(p.y / scale_m), static_cast<float>(p.z / scale_m)};
}

SurfaceVertex surface_vertex(const Vec3& point, const Vec3& normal, double u, double v, double scale_m) {
  const auto weight = [](double x) { return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(x, 0.0, 1.0))); };
  return {to_float(point, scale_m), packed_normal(normal), {weight(u), weight(v), 0, 0}};
}

// Rows of constant v from corner 0's side: row j holds level + 1 - j points.
void append_patch_indices(std::uint32_t base, unsigned level, std::vector<std::uint32_t>& indices) {
  std::uint32_t row = base;
  for (unsigned j = 0; j < level; ++j) {
    const std::uint32_t next = row + level + 1 - j;
    for (unsigned i = 0; i + j < level; ++i) {
      indices.insert(indices.end(), {row + i, row + i + 1, next + i});
      if (i + j + 1 < level) indices.insert(indices.end(), {row + i + 1, next + i + 1, next + i});
    }
    row = next;
  }
}

}  // namespace

std::uint32_t packed_normal(const Vec3& normal) {
  const auto ten_bits = [](double x) {
    return static_cast<std::uint32_t>(std::lround(511.0 * std::clamp(x, -1.0, 1.0))) & 0x3FFu;
  };
  return ten_bits(normal.x) | (ten_bits(normal.y) << 10) | (ten_bits(normal.z) << 20);
}

std::vector<FacetVertex> facet_vertices(const ContactMesh& mesh, double scale_m) {
  std::vector<FacetVertex> vertices;
  vertices.reserve(std::size_t{3} * mesh.usable_triangle_count());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const auto p = mesh.positions(t);
    // Scaled before the product, so that tiny edges don't underflow when squared.
    const Vec3 normal = glm::cross((p[1] - p[0]) / scale_m, (p[2] - p[0]) / scale_m);
    const double length = glm::length(normal);
    const std::uint32_t packed = packed_normal(length > 0.0 ? normal / length : mesh.normal(t, 0));
    for (const Vec3& corner : p) vertices.push_back({to_float(corner, scale_m), packed});
  }
  return vertices;
}

SurfaceMesh corner_normal_mesh(const ContactMesh& mesh, double scale_m) {
  struct Known {
    std::uint32_t index, next;
    Vec3 normal;
  };
  std::vector<std::uint32_t> first(mesh.vertex_count(), kNone);  // linked lists of each vertex's distinct normals
  std::vector<Known> known;
  SurfaceMesh out;
  out.indices.reserve(std::size_t{3} * mesh.usable_triangle_count());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t vertex = mesh.vertex(t, c);
      const Vec3& normal = mesh.normal(t, c);
      std::uint32_t k = first[vertex];
      while (k != kNone && known[k].normal != normal) k = known[k].next;
      if (k == kNone) {
        k = static_cast<std::uint32_t>(known.size());
        known.push_back({static_cast<std::uint32_t>(out.vertices.size()), first[vertex], normal});
        first[vertex] = k;
        out.vertices.push_back(surface_vertex(mesh.position(t, c), normal, 0.0, 0.0, scale_m));
      }
      out.indices.push_back(known[k].index);
    }
  }
  return out;
}

unsigned level_within(std::size_t budget, std::uint32_t patches) {
  const double level = std::sqrt(static_cast<double>(budget) / std::max(patches, 1u));
  return static_cast<unsigned>(std::clamp(level, 1.0, 64.0));
}

SurfaceMesh tessellate(const ContactMesh& mesh, NormalForm form, unsigned level, double scale_m,
                       std::atomic<float>& progress, std::stop_token stop) {
  SurfaceMesh out;
  out.level = level;
  const std::size_t per_patch = std::size_t{level + 1} * (level + 2) / 2;
  out.vertices.reserve(per_patch * mesh.usable_triangle_count());
  out.indices.reserve(std::size_t{3} * level * level * mesh.usable_triangle_count());
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if ((t & 0x3FFu) == 0) {
      if (stop.stop_requested()) return {};
      progress.store(static_cast<float>(t) / static_cast<float>(mesh.triangle_count()), std::memory_order_relaxed);
    }
    if (!mesh.usable(t)) continue;
    const PnPatch patch = make_patch(mesh, t, form);
    append_patch_indices(static_cast<std::uint32_t>(out.vertices.size()), level, out.indices);
    for (unsigned j = 0; j <= level; ++j) {
      for (unsigned i = 0; i + j <= level; ++i) {
        const double u = static_cast<double>(i) / level, v = static_cast<double>(j) / level;
        out.vertices.push_back(
            surface_vertex(evaluate_point(patch, u, v), evaluate_normal(patch, u, v), u, v, scale_m));
      }
    }
  }
  progress.store(1.0f, std::memory_order_relaxed);
  return out;
}

std::vector<FeatureEdge> feature_edges(const ContactMesh& mesh, double scale_m) {
  std::vector<FeatureEdge> edges;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    for (std::uint32_t e = 0; e < 3; ++e) {
      const EdgeKind kind = mesh.edge_kind(t, e);
      if (kind == EdgeKind::smooth) continue;
      if (kind == EdgeKind::crease && mesh.across(t, e).triangle < t) continue;  // its other side drew it
      edges.push_back({to_float(mesh.position(t, e), scale_m), to_float(mesh.position(t, (e + 1) % 3), scale_m), kind});
    }
  }
  return edges;
}

}  // namespace tangent
