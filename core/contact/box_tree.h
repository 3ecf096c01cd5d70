// A tree of boxes in float over things that have one each: which of them are within reach of a query, the nearest first
// as far as boxes tell.
//
// Immutable, no allocation in a query, any number of threads.
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

/// Square of the distance from a point to a box, 0 inside.
inline double distance2_to_box(const Vec3& low, const Vec3& high, const Vec3& point) {
  const Vec3 gap = glm::max(glm::max(low - point, point - high), Vec3(0.0));
  return glm::dot(gap, gap);
}

struct FloatBox {
  std::array<float, 3> min, max;

  static FloatBox about(const Box& box);  ///< rounded outwards
  void include(const FloatBox& other);
  Vec3 low() const { return {min[0], min[1], min[2]}; }
  Vec3 high() const { return {max[0], max[1], max[2]}; }
  double distance2(const Vec3& point) const { return distance2_to_box(low(), high(), point); }
};

class BoxTree {
 public:
  static constexpr std::size_t kLargestLeaf = 8;

  /// The same tree for the same boxes, wherever it is built. Preconditions: a box, fewer than 2^28, 1 <= leaf_size <=
  /// kLargestLeaf.
  static BoxTree build(std::span<const FloatBox> boxes, std::size_t leaf_size);

  /// Calls visit(number of a box) for those within reach, until it returns false; returns whether it never did.
  /// reach2(low, high): the square of the distance to a box, negative where nothing in it is wanted. farthest2(): the
  /// square of the distance up to which things are wanted still; it may shrink on the way.
  template <class Reach, class Farthest, class Visit>
  bool visit(const Reach& reach2, const Farthest& farthest2, Visit&& visit) const {
    return visit_from(
        {}, [&](std::uint32_t, const Vec3& low, const Vec3& high) { return reach2(low, high); }, farthest2, visit);
  }
  /// Where a visit by the distance from a point begins: at a leaf that another one ended at, or at the first (0).
  struct Start {
    std::uint32_t leaf = 0;
    Vec3 point{0.0};
  };
  /// The same, reach2(number of a node, low, high). Where it ends before, `ended`, if given, becomes the leaf.
  template <class Reach, class Farthest, class Visit>
  bool visit_from(const Start& start, const Reach& reach2, const Farthest& farthest2, Visit&& visit,
                  std::uint32_t* ended = nullptr) const;

  std::size_t node_count() const { return nodes_.size(); }
  bool is_leaf(std::uint32_t node) const { return (nodes_[node].link & kLeaf) != 0; }
  /// Numbers of the two nodes below one that is no leaf.
  std::array<std::uint32_t, 2> below(std::uint32_t node) const { return {node + 1, nodes_[node].link}; }
  /// First box of a leaf.
  std::uint32_t box_of(std::uint32_t leaf) const { return order_[nodes_[leaf].link & ((1u << kFirstBits) - 1)]; }
  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node) + order_.capacity() * sizeof(order_[0]); }

 private:
  friend class BoxTreeBuilder;
  static constexpr std::size_t kMaxDepth = 64;
  static constexpr std::uint32_t kLeaf = 0x80000000u, kFirstBits = 28;

  /// Preorder: the first child follows its parent.
  struct Node {
    FloatBox box;
    std::uint32_t link;  ///< second child, or kLeaf | (count - 1) << kFirstBits | first entry in order_
  };

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< numbers of boxes, leaf by leaf
};

template <class Reach, class Farthest, class Visit>
bool BoxTree::visit_from(const Start& start, const Reach& reach2, const Farthest& farthest2, Visit&& visit,
                         std::uint32_t* ended) const {
  struct Entry {
    std::uint32_t node;
    double reach2;
  };
  const auto entry_of = [&](std::uint32_t node) {
    return Entry{node, reach2(node, nodes_[node].box.low(), nodes_[node].box.high())};
  };
  std::array<Entry, kMaxDepth> stack;
  std::size_t size = 0;
  const auto push = [&](const Entry& entry) {
    if (entry.reach2 >= 0.0) stack[size++] = entry;
  };
  // What is left from that leaf on: of two siblings the nearer box was visited first.
  std::uint32_t first = 0;
  while (first != start.leaf && !(nodes_[first].link & kLeaf)) {
    const std::uint32_t a = first + 1, b = nodes_[first].link;
    const bool in_a = start.leaf < b,
               a_first = nodes_[a].box.distance2(start.point) <= nodes_[b].box.distance2(start.point);
    if (in_a == a_first) push(entry_of(in_a ? b : a));
    first = in_a ? a : b;
  }
  push(entry_of(first));
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.reach2 > farthest2()) continue;
    const Node& node = nodes_[entry.node];
    if (node.link & kLeaf) {
      const std::uint32_t first_box = node.link & ((1u << kFirstBits) - 1);
      const std::uint32_t count = ((node.link & ~kLeaf) >> kFirstBits) + 1;
      for (std::uint32_t i = first_box; i < first_box + count; ++i) {
        if (visit(order_[i])) continue;
        if (ended) *ended = entry.node;
        return false;
      }
      continue;
    }
    const Entry a = entry_of(entry.node + 1), b = entry_of(node.link);
    const bool a_first = a.reach2 <= b.reach2;
    push(a_first ? b : a);
    push(a_first ? a : b);
  }
  return true;
}

}  // namespace tangent
