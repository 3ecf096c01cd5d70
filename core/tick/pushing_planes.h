// The planes that push on the finger in one tick, in 3D or 2D, and whether their way out has leapt.
#pragma once

#include "core/base/tolerances.h"
#include "core/contact/touched.h"
#include "core/shading/way_out.h"

#include <algorithm>
#include <array>
#include <span>

namespace tangent {

/// The planes that push together.
class PushingPlanes {
 public:
  void add(const RenderPlane& plane) {
    if (count_ < planes_.size()) planes_[count_++] = plane;
  }
  std::span<const RenderPlane> all() const { return std::span(planes_).first(count_); }
  /// How deep the finger is in the deepest of them, m; 0: in none.
  double deepest_m() const {
    double deepest = 0.0;
    for (const RenderPlane& plane : all()) deepest = std::max(deepest, plane.penetration_m);
    return deepest;
  }
  /// The shortest one. Zero where none is touched, and only then, since it says that no several places push: of planes
  /// that balance, 1e-12 m along the first.
  Vec3 way_out() const {
    const Vec3 way = shortest_way_out(all());
    return way == Vec3(0.0) && deepest_m() > 0.0 ? 1e-12 * planes_[0].normal : way;
  }

 private:
  std::array<RenderPlane, kMostTouched + 1> planes_;
  std::size_t count_ = 0;
};

/// Whether the way out has leapt `before` -> now, by more than the finger's motion explains. `moved_m`: the way of the
/// finger's furthest point since then.
inline bool has_leapt(const Vec3& before, const Vec3& now, double moved_m, double switch_hysteresis_m) {
  const Vec3 change = now - before;
  const double explained = 2.0 * moved_m + kLeapDepth * switch_hysteresis_m;
  return glm::dot(change, change) > explained * explained;
}

}  // namespace tangent
