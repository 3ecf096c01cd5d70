#include "core/mesh/body.h"

#include "core/base/tolerances.h"
#include "core/mesh/union_find.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tangent {
namespace {

bool is_open_at(const SurfaceView& surface, std::uint32_t t) {
  return surface.used(t) && std::ranges::count(surface.links[t], kNone) > 0;
}

}  // namespace

bool is_body(const SurfaceView& surface) {
  const auto count = static_cast<std::uint32_t>(surface.triangles.size());
  std::uint32_t open = 0;
  while (open < count && !is_open_at(surface, open)) ++open;
  if (open == count) return true;
  UnionFind parts(count), loops(static_cast<std::uint32_t>(surface.positions.size()));
  for (std::uint32_t t = 0; t < count; ++t) {
    if (!surface.used(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t link = surface.links[t][k];
      if (link != kNone)
        parts.join(t, link >> 2);
      else
        loops.join(surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]);
    }
  }
  std::vector<double> length_m(surface.positions.size());  // of loops of boundary sides, by their first vertices
  for (std::uint32_t t = open; t < count; ++t) {
    if (!surface.used(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k)
      if (surface.links[t][k] == kNone)
        length_m[loops.root(surface.triangles[t][k])] +=
            glm::distance(surface.position({t, k}), surface.position({t, (k + 1) % 3}));
  }
  std::vector<double> room_m2(count);  // by the parts' first triangles: what their holes may have, less what they have
  for (std::uint32_t t = 0; t < count; ++t) {
    if (!surface.used(t)) continue;
    const Vec3& p = surface.position({t, 0});
    const Vec3 area = glm::cross(surface.position({t, 1}) - p, surface.position({t, 2}) - p);
    double& room = room_m2[parts.root(t)];
    room += kHoleShare * 0.5 * std::sqrt(glm::dot(area, area));
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (surface.links[t][k] != kNone) continue;
      double& length = length_m[loops.root(surface.triangles[t][k])];
      room -= length * length / (4.0 * std::numbers::pi);
      length = 0.0;  // each once
    }
  }
  for (std::uint32_t t = 0; t < count; ++t)
    if (surface.used(t) && parts.root(t) == t && !(room_m2[t] > 0.0)) return false;
  return true;
}

}  // namespace tangent
