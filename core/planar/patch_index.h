// Which patches and segments of a planar curve are near a place, without looking at the others.
//
// Neighbours on the curve are neighbours in the plane, so the order of the polygon is the order of the tree: each node
// is a box around a run of patches, half of it on either side below, with the directions in which the curve goes there.
// Immutable; a query allocates nothing.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <bit>
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

/// Directions of a run of the curve, rad. They go on where the item before ended, so that runs can be joined: after a
/// left turn all the way round they are 2 pi larger.
struct DirectionRange {
  double low_rad = 1e300, high_rad = -1e300;
  void include(const DirectionRange& r) {
    low_rad = std::min(low_rad, r.low_rad), high_rad = std::max(high_rad, r.high_rad);
  }
};

class PatchIndex {
 public:
  /// One box an item, and the directions of its tangent lines and of those in the corner behind it, in the curve's
  /// order. An item with an end of the curve has all directions. `rounding_m`: by what a place may lie off its box.
  static PatchIndex build(std::span<const PlanarBox> items, std::span<const DirectionRange> directions,
                          double rounding_m);

  /// Calls look(item) for every item whose run's box is within sqrt(bound2) of `at`, nearer runs first. `look` may
  /// lower the bound; what lies at the bound exactly is still looked at, so that ties can go to the lowest item.
  template <class Look>
  void each_within(const Vec2& at, const double& bound2, Look look) const {
    // Of a bend about `at` both boxes hold it: the runs' middles tell which way the curve comes nearer.
    const auto middles = [&](const Entry& far, const Entry& near) { return middle_is_nearer(far, near, at); };
    visit(
        at, bound2, [](std::uint32_t) { return false; }, middles, look);
  }

  /// The same without runs in which no place's normal passes through `at`: those cannot hold a contact.
  template <class Look>
  void each_facing(const Vec2& at, const double& bound2, Look look) const {
    // Mostly nothing is found and the order is of no use, so boxes alone tell it where they can.
    const auto boxes = [&](const Entry& far, const Entry& near) {
      if (far.distance2 != near.distance2) return far.distance2 < near.distance2;
      return far.distance2 <= bound2 && middle_is_nearer(far, near, at);
    };
    visit(
        at, bound2, [&](std::uint32_t node) { return passes_by(node, at); }, boxes, look);
  }

  /// Towards the end (`forwards`) or the start of the curve: the nearest item, from `item` on, of a run that `at` may
  /// not have passed as a whole. It is ahead, or behind, of every place and tangent line of the runs before; none: of
  /// all up to there.
  std::uint32_t first_not_passed(std::uint32_t item, bool forwards, const Vec2& at) const;

  std::size_t memory_bytes() const { return nodes_.size() * (sizeof(PlanarBox) + sizeof(Cone)); }

 private:
  static constexpr std::uint32_t kRun = 8;  ///< items of a leaf

  /// Directions within `half` of the middle one; all of them where cos_half is below 0.
  struct Cone {
    Vec2 middle{1.0, 0.0};
    double cos_half = -1.0, sin_half = 0.0;
  };

  /// 1: `at` is ahead of every place of the run in every direction of it, -1: behind all; 0: neither is certain.
  int side_of(std::uint32_t node, const Vec2& at) const;
  bool passes_by(std::uint32_t node, const Vec2& at) const { return side_of(node, at) != 0; }
  struct Entry {
    std::uint32_t node;
    double distance2;
  };
  bool middle_is_nearer(const Entry& a, const Entry& b, const Vec2& at) const {
    return nodes_[middle_leaf(a.node)].distance2(at) < nodes_[middle_leaf(b.node)].distance2(at);
  }

  /// The node of the leaf in the middle of a node's run.
  std::uint32_t middle_leaf(std::uint32_t node) const {
    const int levels = std::bit_width(leaves_) - std::bit_width(node);
    return levels == 0 ? node : (node << levels) + (1u << (levels - 1));
  }
  template <class Skip, class IsNearer, class Look>
  void visit(const Vec2& at, const double& bound2, Skip skip, IsNearer is_nearer, Look look) const;

  std::uint32_t count_ = 0;       ///< items
  std::uint32_t leaves_ = 1;      ///< a power of two
  std::vector<PlanarBox> nodes_;  ///< as a heap from 1: children of k are 2k and 2k + 1; leaf l is leaves_ + l
  std::vector<Cone> cones_;       ///< of the nodes
  double rounding_m_ = 0.0;
};

template <class Skip, class IsNearer, class Look>
void PatchIndex::visit(const Vec2& at, const double& bound2, Skip skip, IsNearer is_nearer, Look look) const {
  std::array<Entry, 32> stack;  // one a level, and the depth is at most that of 2^20 leaves
  std::size_t size = 0;
  stack[size++] = {1, nodes_[1].distance2(at)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance2 > bound2 || skip(entry.node)) continue;
    if (entry.node >= leaves_) {
      const std::uint32_t first = (entry.node - leaves_) * kRun;
      for (std::uint32_t i = first; i < count_ && i < first + kRun; ++i) look(i);
      continue;
    }
    Entry near{2 * entry.node, nodes_[2 * entry.node].distance2(at)};
    Entry far{2 * entry.node + 1, nodes_[2 * entry.node + 1].distance2(at)};
    if (is_nearer(far, near)) std::swap(near, far);
    if (far.distance2 <= bound2) stack[size++] = far;
    if (near.distance2 <= bound2) stack[size++] = near;
  }
}

}  // namespace tangent
