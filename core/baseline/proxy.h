// A proxy: a ball that stands where the finger would be if the obstacles let it (Ruspini, Kolarov & Khatib, "The Haptic
// Display of Complex Graphical Environments", SIGGRAPH 1997). The same code serves meshes and, with z = 0, polygons.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstddef>
#include <span>

namespace tangent {

inline constexpr std::size_t kProxyObstacles = 24;

/// Closest points of the convex obstacles near the proxy (triangles, segments), nearest first.
using ProxyObstacles = std::array<Vec3, kProxyObstacles>;

/// n.x >= offset.
struct HalfSpace {
  Vec3 normal{0.0};     ///< unit
  double offset = 0.0;  ///< m
};

/// The point of all half-spaces that is nearest to `goal`; false where none was found.
bool nearest_in(std::span<const HalfSpace> spaces, const Vec3& goal, Vec3& point);

/// An ordinary proxy update: from `proxy`, whose ball of `radius_m` is free, towards `goal`, never into an obstacle.
/// A ball that stays beyond the plane through an obstacle's closest point, square to the line to it, stays off the
/// obstacle, since that is convex: so each round finds the point nearest to the goal beyond all those planes and asks
/// for the obstacles there. `near(centre, reach, out)` fills closest points within reach and returns how many.
/// Stops when a round moves it by less than `tolerance_m`.
template <class Near>
Vec3 update_proxy(Vec3 proxy, const Vec3& goal, double radius_m, double tolerance_m, Near near) {
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    const Vec3 way = goal - proxy;
    ProxyObstacles closest;
    const std::size_t count = near(proxy, radius_m + std::sqrt(glm::dot(way, way)), closest);
    std::array<HalfSpace, kProxyObstacles> spaces;
    std::size_t used = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 away = proxy - closest[i];
      const double distance = std::sqrt(glm::dot(away, away));
      if (!(distance > 0.0)) continue;
      const Vec3 normal = away / distance;
      spaces[used++] = {normal, glm::dot(normal, closest[i]) + radius_m};
    }
    Vec3 next;
    if (!nearest_in({spaces.data(), used}, goal, next)) return proxy;
    const Vec3 moved = next - proxy;
    proxy = next;
    if (glm::dot(moved, moved) < tolerance_m * tolerance_m) break;
  }
  return proxy;
}

}  // namespace tangent
