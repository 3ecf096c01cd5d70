#include "workbench/gui/render/surface_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace tangent {
namespace {

struct Cluster {
  Vec3 point{0.0}, normal{0.0};
  double weight = 0.0;
};

/// Clusters the vertices in a grid of `cells` cells along the longest side; returns each vertex's cluster.
std::vector<std::uint32_t> cluster_of_vertices(const ContactMesh& mesh, double cells, std::vector<Cluster>& clusters) {
  const Box& box = mesh.bounds();
  const Vec3 size = box.size();
  const double cell = std::max({size.x, size.y, size.z}) / cells;
  std::vector<std::uint32_t> cluster(mesh.vertex_count(), kNone);
  std::unordered_map<std::uint64_t, std::uint32_t> known;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 place = (mesh.vertex_position(v) - box.min) / cell;
    // Vertices of no usable triangle may lie anywhere.
    const auto index = [&](double x) { return static_cast<std::uint64_t>(std::clamp(x, 0.0, cells)) & 0xFFFFFu; };
    const std::uint64_t key = index(place.x) | (index(place.y) << 20) | (index(place.z) << 40);
    const auto [at, fresh] = known.try_emplace(key, static_cast<std::uint32_t>(clusters.size()));
    if (fresh) clusters.emplace_back();
    cluster[v] = at->second;
  }
  return cluster;
}

template <class Visit>
void for_each_kept(const ContactMesh& mesh, const std::vector<std::uint32_t>& cluster, Visit visit) {
  std::uint32_t usable = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const std::uint32_t index = usable++;
    const std::uint32_t a = cluster[mesh.vertex(t, 0)], b = cluster[mesh.vertex(t, 1)], c = cluster[mesh.vertex(t, 2)];
    if (a != b && b != c && c != a) visit(index, a, b, c);
  }
}

}  // namespace

SurfaceMesh clustered_mesh(const ContactMesh& mesh, double scale_m, std::size_t target) {
  // With n cells per side a surface crosses about n^2 of them.
  double cells = std::sqrt(static_cast<double>(target) / 6.0);
  std::vector<Cluster> clusters;
  std::vector<std::uint32_t> cluster;
  for (int attempt = 0; attempt < 8; ++attempt) {
    clusters.clear();
    cluster = cluster_of_vertices(mesh, cells, clusters);
    std::size_t kept = 0;
    for_each_kept(mesh, cluster, [&](std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t) { ++kept; });
    if (kept <= target && (attempt >= 3 || kept > target / 2)) break;
    const double wanted = 0.8 * static_cast<double>(target) / static_cast<double>(std::max<std::size_t>(kept, 1));
    cells = std::clamp(cells * std::sqrt(wanted), 2.0, 1e6);
  }
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      Cluster& into = clusters[cluster[mesh.vertex(t, k)]];
      into.point += mesh.position(t, k) / scale_m;
      into.normal += mesh.normal(t, k);
      into.weight += 1.0;
    }
  }
  SurfaceMesh out;
  for (const Cluster& c : clusters) {
    const Vec3 point = c.weight > 0.0 ? c.point / c.weight : Vec3(0.0);
    const Vec3 normal = glm::dot(c.normal, c.normal) > 0.0 ? unit(c.normal) : Vec3(0.0, 0.0, 1.0);
    out.vertices.push_back({{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z)},
                            packed_normal(normal),
                            {0, 0, 0, 0}});
  }
  for_each_kept(mesh, cluster, [&](std::uint32_t source, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out.indices.insert(out.indices.end(), {a, b, c});
    out.sources.push_back(source);
  });
  return out;
}

}  // namespace tangent
