// Times of other libraries for the closest point on the raw mesh: only the query, no contact, no shading.
#pragma once

#include "core/lab/measure/distribution.h"
#include "core/tick/step.h"
#include "workbench/bench/tick_clock.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tangent::bench {

using Stop = std::function<bool()>;  ///< polled now and then; true ends the work early

struct PeerReport {
  std::string name;
  double build_s = 0.0;                 ///< of its search tree; 0 for Embree, whose tree the scene has anyway
  Distribution ns;                      ///< of one query
  double largest_disagreement_m = 0.0;  ///< between its distances and Embree's
};

/// Embree through NearestTriangles::nearest: culled in float, exact in double.
PeerReport embree_peer(const ContactScene& scene, std::span<const TickInput> poses, int repeats, const TickClock& clock,
                       const Stop& stop);

/// The same, bounded by the distance to the triangle that was the nearest at the last pose: how a nearest point is
/// tracked from tick to tick.
PeerReport embree_bounded_peer(const ContactScene& scene, std::span<const TickInput> poses, int repeats,
                               const TickClock& clock, const Stop& stop);
inline constexpr const char* kEmbreeBounded = "embree bounded";

/// Larger meshes are left out, for memory and the time the tree takes to build.
inline constexpr std::uint32_t kMostCgalTriangles = 2'000'000;

/// CGAL's AABB tree. Empty in a program built without CGAL and for meshes over kMostCgalTriangles.
std::optional<PeerReport> cgal_peer(const ContactScene& scene, std::span<const TickInput> poses, int repeats,
                                    const TickClock& clock, const Stop& stop);

/// Times query(point) at every pose; the minimum of `repeats` passes.
template <class Query>
Distribution query_times(const ContactScene& scene, std::span<const TickInput> poses, int repeats,
                         const TickClock& clock, const Stop& stop, Query query) {
  std::vector<double> ns(poses.size(), 1e300);
  for (int pass = 0; pass < repeats; ++pass) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i % 256 == 0 && stop()) return {};
      const Vec3 point = poses[i].finger.position - scene.mesh().origin();
      const std::int64_t from = clock.mark();
      query(i, point);
      const std::int64_t to = clock.mark();
      ns[i] = std::min(ns[i], clock.elapsed_ns(from, to));
    }
  }
  return distribution(std::move(ns));
}

}  // namespace tangent::bench
