// Which patches and segments of a planar curve are near a place, without looking at the others.
//
// Neighbours on the curve are neighbours in the plane, so the order of the polygon is the order of the tree: each node
// is a box around a run of patches, half of it on either side below. Immutable; a query allocates nothing.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

/// Axis-aligned, m.
struct PlanarBox {
  Vec2 low{1e300}, high{-1e300};
  void include(const Vec2& p) { low = glm::min(low, p), high = glm::max(high, p); }
  void include(const PlanarBox& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
  double distance2(const Vec2& at) const {
    const Vec2 gap = glm::max(glm::max(low - at, at - high), Vec2(0.0));
    return glm::dot(gap, gap);
  }
};

class PatchIndex {
 public:
  /// One box an item, in the curve's order.
  static PatchIndex build(std::span<const PlanarBox> items);

  /// Calls look(item) for every item whose run's box is within sqrt(bound2) of `at`, nearer boxes first. `look` may
  /// lower the bound; what lies at the bound exactly is still looked at, so that ties can go to the lowest item.
  template <class Look>
  void each_within(const Vec2& at, const double& bound2, Look look) const;

  std::size_t memory_bytes() const { return nodes_.size() * sizeof(PlanarBox); }

 private:
  static constexpr std::uint32_t kRun = 8;  ///< items of a leaf

  std::uint32_t count_ = 0;       ///< items
  std::uint32_t leaves_ = 1;      ///< a power of two
  std::vector<PlanarBox> nodes_;  ///< as a heap from 1: children of k are 2k and 2k + 1; leaf l is leaves_ + l
};

template <class Look>
void PatchIndex::each_within(const Vec2& at, const double& bound2, Look look) const {
  struct Entry {
    std::uint32_t node;
    double distance2;
  };
  std::array<Entry, 32> stack;  // one a level, and the depth is at most that of 2^20 leaves
  std::size_t size = 0;
  stack[size++] = {1, nodes_[1].distance2(at)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance2 > bound2) continue;
    if (entry.node >= leaves_) {
      const std::uint32_t first = (entry.node - leaves_) * kRun;
      for (std::uint32_t i = first; i < count_ && i < first + kRun; ++i) look(i);
      continue;
    }
    Entry near{2 * entry.node, nodes_[2 * entry.node].distance2(at)};
    Entry far{2 * entry.node + 1, nodes_[2 * entry.node + 1].distance2(at)};
    if (far.distance2 < near.distance2) std::swap(near, far);
    if (far.distance2 <= bound2) stack[size++] = far;
    if (near.distance2 <= bound2) stack[size++] = near;
  }
}

}  // namespace tangent
