#include "workbench/bench/peers.h"

#include <limits>

namespace tangent::bench {

PeerReport embree_peer(const ContactScene& scene, std::span<const TickInput> poses, const TickClock& clock, const Stop& stop) {
  PeerReport report;
  report.name = "embree closest point";
  std::vector<double> ns;
  ns.reserve(poses.size());
  double sum = 0.0;
  for (const TickInput& input : poses) {
    if (ns.size() % 256 == 0 && stop()) break;
    const Vec3 query = input.finger.position - scene.mesh().origin();
    const std::int64_t from = TickClock::now();
    const NearestHit hit = scene.nearest().nearest(query, std::numeric_limits<double>::infinity());
    const std::int64_t to = TickClock::now();
    sum += hit.distance_m;
    ns.push_back(clock.elapsed_ns(from, to));
  }
  report.ns = distribution(std::move(ns));
  // The sum keeps the queries from being optimised away.
  report.largest_disagreement_m = sum >= 0.0 ? 0.0 : -1.0;
  return report;
}

}  // namespace tangent::bench
