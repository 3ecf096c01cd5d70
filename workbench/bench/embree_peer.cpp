#include "workbench/bench/peers.h"

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

}  // namespace tangent::bench
