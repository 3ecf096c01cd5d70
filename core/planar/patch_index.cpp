#include "core/planar/patch_index.h"

#include <bit>

namespace tangent {

PatchIndex PatchIndex::build(std::span<const PlanarBox> items) {
  PatchIndex index;
  index.count_ = static_cast<std::uint32_t>(items.size());
  index.leaves_ = std::bit_ceil((index.count_ + kRun - 1) / kRun);
  index.nodes_.resize(2 * std::size_t{index.leaves_});
  for (std::uint32_t i = 0; i < index.count_; ++i) index.nodes_[index.leaves_ + i / kRun].include(items[i]);
  for (std::uint32_t node = index.leaves_ - 1; node > 0; --node) {
    index.nodes_[node] = index.nodes_[2 * std::size_t{node}];
    index.nodes_[node].include(index.nodes_[2 * std::size_t{node} + 1]);
  }
  return index;
}

}  // namespace tangent
