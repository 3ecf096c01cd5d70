#include "workbench/bench/peers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent::bench {

PeerReport embree_peer(const ContactScene& scene, std::span<const TickInput> poses, int repeats, const TickClock& clock,
                       const Stop& stop) {
  PeerReport report;
  report.name = "embree closest point";
  // Stored, so that the compiler can't remove a query.
  std::vector<double> distances(poses.size());
  report.ns = query_times(scene, poses, repeats, clock, stop, [&](std::size_t i, const Vec3& point) {
    distances[i] = scene.nearest().nearest(point, std::numeric_limits<double>::infinity()).distance_m;
  });
  return report;
}

PeerReport embree_bounded_peer(const ContactScene& scene, std::span<const TickInput> poses, int repeats,
                               const TickClock& clock, const Stop& stop) {
  PeerReport report;
  report.name = kEmbreeBounded;
  std::vector<double> distances(poses.size());
  std::uint32_t last = kNone;
  report.ns = query_times(scene, poses, repeats, clock, stop, [&](std::size_t i, const Vec3& point) {
    const double radius = i == 0 || last == kNone ? std::numeric_limits<double>::infinity()
                                                  : closest_on_triangle(scene.mesh(), last, point).distance_m;
    const NearestHit hit = scene.nearest().nearest(point, radius);
    last = hit.triangle;
    distances[i] = hit.distance_m;
  });
  for (std::size_t i = 0; i < poses.size() && report.ns.count > 0; ++i) {
    const Vec3 point = poses[i].finger.position - scene.mesh().origin();
    const double nearest = scene.nearest().nearest(point, std::numeric_limits<double>::infinity()).distance_m;
    report.largest_disagreement_m = std::max(report.largest_disagreement_m, std::abs(nearest - distances[i]));
  }
  return report;
}

}  // namespace tangent::bench
