// All uses of every edge of a triangle soup, side by side: what topology and audit are made from.
// Linear in the number of triangles but for sorting within a vertex, so neither file order nor a vertex with
// a million triangles makes it slow.
#pragma once

#include "core/base/run_both.h"
#include "core/base/unfilled.h"
#include "core/mesh/fan_walk.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

inline constexpr std::uint32_t kMaxTriangles = 1u << 28;  ///< triangle << 3 | part of it in 31 bits (Clearance)

/// One use of an edge by a triangle.
class EdgeUse {
 public:
  EdgeUse() = default;
  EdgeUse(std::uint32_t far_vertex, bool backward, std::uint32_t packed)
      : bits_(std::uint64_t{far_vertex} << 32 | std::uint64_t{backward} << 31 | packed) {}
  std::uint32_t far_vertex() const { return static_cast<std::uint32_t>(bits_ >> 32); }
  bool backward() const { return (bits_ >> 31) & 1u; }  ///< runs from the higher vertex to the lower
  std::uint32_t packed() const { return static_cast<std::uint32_t>(bits_) & 0x7FFFFFFFu; }  ///< triangle << 2 | edge
  std::uint32_t triangle() const { return packed() >> 2; }
  std::uint32_t edge() const { return packed() & 3u; }
  friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;

 private:
  std::uint64_t bits_;
};

class EdgeTable {
 public:
  /// Triangles whose first vertex is kNone are left out.
  /// Precondition: at most kMaxTriangles; the vertices of a triangle differ and are below vertex_count.
  EdgeTable(std::span<const Index3> triangles, std::uint32_t vertex_count, const RunBoth& run_both = run_in_turn);

  std::size_t vertex_count() const { return begin_.size() - 1; }
  std::size_t use_count() const { return uses_.size(); }

  /// Calls visit(low_vertex, uses) for every edge, by ascending vertices; uses: forward ones first, each by triangle.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for_each_edge(0, vertex_count(), visit);
  }
  /// Of those whose lower vertex is in [first_low, last_low).
  template <class Visit>
  void for_each_edge(std::size_t first_low, std::size_t last_low, Visit visit) const {
    for (auto low = static_cast<std::uint32_t>(first_low); low < last_low; ++low) {
      const EdgeUse* use = uses_.data() + begin_[low];
      const EdgeUse* const end = uses_.data() + begin_[low + 1];
      while (use != end) {
        const EdgeUse* last = use + 1;
        while (last != end && last->far_vertex() == use->far_vertex()) ++last;
        visit(low, std::span<const EdgeUse>(use, last));
        use = last;
      }
    }
  }

 private:
  std::vector<std::uint32_t> begin_;  ///< per lower vertex, its first use
  Unfilled<EdgeUse> uses_;
};

}  // namespace tangent
