// The two factors of a patch's misses: c - S and N by their control points, in a frame about the middle of the normals.
#pragma once

#include "core/contact/prove/miss_folds.h"
#include "core/surface/pn_patch.h"

namespace tangent::miss {

/// A vector in a frame (t, s, axis): its first two components side by side, the third twice.
struct InFrame {
  Two across, along;
  double z() const { return along[0]; }
  Vec3 vector() const { return {across[0], across[1], along[0]}; }
};

/// c - S and N by their control points, in a frame (t, s, axis) about the middle of the normals.
struct Factors {
  Vec3 centre, t, s, axis;  ///< c relative to corner 0; the directions
  double rounding_m;        ///< of f
  std::array<InFrame, 10> d;
  std::array<InFrame, 6> n;

  /// False where the corner normals have no middle.
  bool set(const PnPatch& patch, const Vec3& c);

  /// Whether a test holds for f at any of the corners.
  template <class Test>
  bool any_corner(Test test) const {
    const auto at = [&](std::size_t k) {
      const Two f = n[k].along * d[k].across - d[k].along * n[k].across;
      return Vec2(f[0], f[1]);
    };
    return test(at(0)) || test(at(1)) || test(at(2));
  }

  /// f over the whole patch.
  Part whole() const;

  /// Lower bound of |c - S|, along the axis: at a contact that is its height.
  double least_height_m() const {
    double least = d[0].z();
    for (const InFrame& x : d) least = std::min(least, x.z());
    return std::max(0.0, least);
  }

  /// `sides`: of the flat triangle, from corner 0 to 1 and to 2.
  Ground ground(const std::array<Vec3, 2>& sides) const;
};

}  // namespace tangent::miss
