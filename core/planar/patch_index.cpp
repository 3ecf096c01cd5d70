#include "core/planar/patch_index.h"

#include "core/mesh/polygon_mesh.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

/// rad by which directions may be rounded: some 1e-16 a radian, and a curve may wind round a million times. Larger: a
/// run of that many more is asked in vain.
constexpr double kDirectionRoom = 1e-9;

}  // namespace

PatchIndex PatchIndex::build(std::span<const PlanarBox> items, std::span<const DirectionRange> directions,
                             double rounding_m) {
  PatchIndex index;
  index.rounding_m_ = rounding_m;
  index.count_ = static_cast<std::uint32_t>(items.size());
  index.leaves_ = std::bit_ceil((index.count_ + kRun - 1) / kRun);
  index.nodes_.resize(2 * std::size_t{index.leaves_});
  std::vector<DirectionRange> ranges(index.nodes_.size());
  for (std::uint32_t i = 0; i < index.count_; ++i) {
    index.nodes_[index.leaves_ + i / kRun].include(items[i]);
    ranges[index.leaves_ + i / kRun].include(directions[i]);
  }
  for (std::uint32_t node = index.leaves_ - 1; node > 0; --node) {
    for (const std::size_t child : {2 * std::size_t{node}, 2 * std::size_t{node} + 1}) {
      index.nodes_[node].include(index.nodes_[child]);
      ranges[node].include(ranges[child]);
    }
  }
  index.cones_.resize(ranges.size());
  for (std::size_t node = 1; node < ranges.size(); ++node) {
    const double half = 0.5 * (ranges[node].high_rad - ranges[node].low_rad) + kDirectionRoom;
    if (!(half < 0.5 * std::numbers::pi)) continue;
    const double middle = 0.5 * (ranges[node].low_rad + ranges[node].high_rad);
    index.cones_[node] = {{std::cos(middle), std::sin(middle)}, std::cos(half), std::sin(half)};
  }
  return index;
}

// A place P holds a contact in direction d where (at - P).d = 0. With w from the box's middle to `at` and `reach` half
// its diagonal, (at - P).d lies within `reach` of w.d, and w.d between |w| cos(a + half) and |w| cos(a - half), where a
// is the angle between w and the middle direction. So all are ahead if |w| cos(a + half) > reach; behind likewise.
int PatchIndex::side_of(std::uint32_t node, const Vec2& at) const {
  const PlanarBox& box = nodes_[node];
  const Cone& cone = cones_[node];
  const Vec2 w = at - 0.5 * (box.low + box.high), size = box.high - box.low;
  const double towards = glm::dot(w, cone.middle), along = std::abs(towards);
  const double across = std::abs(w.x * cone.middle.y - w.y * cone.middle.x);
  const double clear = along * cone.cos_half - across * cone.sin_half - rounding_m_;
  if (!(clear > 0.0 && 4.0 * clear * clear > glm::dot(size, size))) return 0;
  return towards > 0.0 ? 1 : -1;
}

std::uint32_t PatchIndex::first_not_passed(std::uint32_t item, bool forwards, const Vec2& at) const {
  const int passed = forwards ? 1 : -1;
  // Children with this last bit come last on the way.
  const std::uint32_t last = forwards ? 1 : 0;
  std::uint32_t node = leaves_ + item / kRun;
  if (side_of(node, at) != passed) return item;
  for (;;) {
    while (node > 1 && (node & 1u) == last) node >>= 1;
    if (node <= 1) return kNone;
    node ^= 1u;
    while (side_of(node, at) != passed) {
      if (node >= leaves_) {
        const std::uint32_t first = (node - leaves_) * kRun;
        if (first >= count_) return kNone;
        return forwards ? first : std::min(first + kRun, count_) - 1;
      }
      node = 2 * node + (1u - last);
    }
  }
}

}  // namespace tangent
