#include "core/baseline/two_pass.h"

#include <algorithm>
#include <cmath>

namespace tangent {

std::size_t MeshProxySurface::near(const Vec3& centre, double reach_m, ProxyObstacles& closest) const {
  std::array<NearestHit, kProxyObstacles> hits;
  const std::size_t count = nearest_.nearest_several(centre, reach_m, hits);
  for (std::size_t i = 0; i < count; ++i) closest[i] = hits[i].point;
  return count;
}

TwoPassContact two_pass_contact(const ProxySurface& surface, const Vec3& centre, double radius_m, double tolerance_m,
                                const Vec3* kept, double leap_m) {
  TwoPassContact out;
  const double radius = std::max(radius_m, kLeastProxyRadius);
  const FacetContact at_finger = surface.nearest(centre);
  if (!at_finger.found) return out;
  out.found = true;
  const auto on_surface = [&](const FacetContact& facet) { return facet.hit.point + radius * facet.normal; };
  const auto near = [&](const Vec3& at, double reach, ProxyObstacles& closest) {
    return surface.near(at, reach, closest);
  };

  // First pass: the ordinary proxy. A new one starts at the finger, or straight above it on the surface.
  const bool follow = kept != nullptr && glm::length(*kept - centre) <= leap_m;
  const Vec3 start = follow ? *kept : at_finger.height_m >= radius ? centre : on_surface(at_finger);
  const Vec3 first = update_proxy(start, centre, radius, tolerance_m, near);
  out.proxy = first;
  out.facet = surface.nearest(first);
  const Vec3 push = first - centre;
  if (glm::dot(push, push) <= tolerance_m * tolerance_m) {
    // The proxy is where the finger is: not touching.
    out.normal = out.facet.normal;
    out.penetration_m = radius_m - out.facet.height_m;
    return out;
  }

  // Second pass: towards the finger's closest point on the shaded plane, and down to the surface again.
  const Vec3 shaded = surface.interpolated_normal(out.facet);
  const Vec3 goal = centre + glm::dot(push, shaded) * shaded;
  out.proxy = update_proxy(first, goal, radius, tolerance_m, near);
  out.facet = surface.nearest(out.proxy);
  if (out.facet.height_m > radius + tolerance_m) {
    out.proxy = on_surface(out.facet);
    out.facet = surface.nearest(out.proxy);
  }
  const Vec3 spring = out.proxy - centre;
  const double length = glm::length(spring);
  out.normal = length > tolerance_m ? spring / length : shaded;
  out.penetration_m = length - (radius - radius_m);
  return out;
}

}  // namespace tangent
