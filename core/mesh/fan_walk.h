// Turning about a vertex from triangle to triangle, over packed links (triangle << 2 | edge, kNone at a boundary).
#pragma once

#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

using Index3 = std::array<std::uint32_t, 3>;

inline constexpr std::uint32_t next3(std::uint32_t k) { return k == 2 ? 0 : k + 1; }
inline constexpr std::uint32_t previous3(std::uint32_t k) { return k == 0 ? 2 : k - 1; }

struct Corner {
  std::uint32_t triangle = kNone, corner = 0;
  bool none() const { return triangle == kNone; }
  friend bool operator==(const Corner&, const Corner&) = default;
};

/// The edge that is crossed by turning counter-clockwise (seen from outside): the one arriving at the corner.
inline std::uint32_t edge_left(Corner c) { return previous3(c.corner); }
/// The edge that is crossed by turning clockwise: the one leaving the corner.
inline std::uint32_t edge_right(Corner c) { return c.corner; }

/// Next corner of the same vertex, counter-clockwise; none at a boundary. The link leads to the same edge run the
/// other way, so it leaves our vertex there: its number is the corner's.
inline Corner turn_left(std::span<const Index3> links, Corner c) {
  const std::uint32_t packed = links[c.triangle][edge_left(c)];
  return packed == kNone ? Corner{} : Corner{packed >> 2, packed & 3u};
}

/// Next corner of the same vertex, clockwise; none at a boundary.
inline Corner turn_right(std::span<const Index3> links, Corner c) {
  const std::uint32_t packed = links[c.triangle][edge_right(c)];
  return packed == kNone ? Corner{} : Corner{packed >> 2, next3(packed & 3u)};
}

/// One bit a corner, for visiting each once.
class CornerSet {
 public:
  explicit CornerSet(std::size_t triangles) : bits_(triangles, 0) {}
  bool has(Corner c) const { return (bits_[c.triangle] >> c.corner) & 1u; }
  void insert(Corner c) { bits_[c.triangle] = static_cast<std::uint8_t>(bits_[c.triangle] | 1u << c.corner); }

 private:
  std::vector<std::uint8_t> bits_;
};

}  // namespace tangent
