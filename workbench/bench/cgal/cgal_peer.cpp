#include "workbench/bench/peers.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tangent::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace

std::optional<PeerReport> cgal_peer(const ContactScene& scene, std::span<const TickInput> poses, int repeats,
                                    const TickClock& clock, const Stop& stop) {
  const ContactMesh& mesh = scene.mesh();
  if (mesh.triangle_count() > kMostCgalTriangles) return std::nullopt;
  PeerReport report;
  report.name = "cgal closest point";
  Triangles triangles;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.usable(t))
      triangles.emplace_back(point(mesh.position(t, 0)), point(mesh.position(t, 1)), point(mesh.position(t, 2)));
  }
  const std::int64_t start = TickClock::now();
  Tree tree(triangles.begin(), triangles.end());
  tree.build();
  tree.accelerate_distance_queries();
  report.build_s = 1e-9 * static_cast<double>(TickClock::now() - start);
  std::vector<Vec3> closest(poses.size(), Vec3(0.0));
  report.ns = query_times(scene, poses, repeats, clock, stop, [&](std::size_t i, const Vec3& query) {
    const Kernel::Point_3 found = tree.closest_point_and_primitive(point(query)).first;
    closest[i] = {found.x(), found.y(), found.z()};
  });
  for (std::size_t i = 0; i < poses.size() && !stop(); ++i) {
    const Vec3 query = poses[i].finger.position - mesh.origin(), d = query - closest[i];
    const double exact = scene.nearest().nearest(query, std::numeric_limits<double>::infinity()).distance_m;
    report.largest_disagreement_m =
        std::max(report.largest_disagreement_m, std::abs(std::sqrt(glm::dot(d, d)) - exact));
  }
  return report;
}

}  // namespace tangent::bench
