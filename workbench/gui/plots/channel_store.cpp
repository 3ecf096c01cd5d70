#include "workbench/gui/plots/channel_store.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace tangent {

ChannelStore::ChannelStore(std::size_t channels, std::size_t capacity)
    : channels_(channels), gap_(channels, std::numeric_limits<float>::quiet_NaN()) {
  assert(channels > 0);
  constexpr std::size_t largest = std::size_t{1} << (kShift * kLevels);
  capacity_ = std::bit_ceil(std::max(capacity, largest));
  samples_.assign(channels_ * capacity_, gap_[0]);
  for (std::size_t level = 1; level <= kLevels; ++level) {
    levels_.emplace_back(channels_ * (capacity_ >> (kShift * level)));
  }
}

std::size_t ChannelStore::memory_bytes() const {
  std::size_t bytes = samples_.size() * sizeof(float);
  for (const auto& level : levels_) bytes += level.size() * sizeof(MinMax);
  return bytes;
}

void ChannelStore::clear() { first_ = end_ = 0; }

void ChannelStore::push(std::uint64_t tick, std::span<const float> values) {
  assert(values.size() == channels_);
  if (!empty() && (tick < end_ || tick - end_ >= capacity_)) clear();
  if (empty()) {
    // Blocks are only emptied when their first tick passes, so a store that starts inside a block takes
    // the block's earlier ticks as gaps.
    constexpr std::uint64_t largest = std::uint64_t{1} << (kShift * kLevels);
    end_ = tick - tick % largest;
    while (end_ < tick) put(end_, gap_);
    first_ = tick;
  }
  while (end_ < tick) put(end_, gap_);
  put(tick, values);
  if (end_ - first_ > capacity_) first_ = end_ - capacity_;
}

void ChannelStore::put(std::uint64_t tick, std::span<const float> values) {
  const std::size_t at = slot(tick);
  for (std::size_t channel = 0; channel < channels_; ++channel) {
    samples_[channel * capacity_ + at] = values[channel];
  }
  for (std::size_t level = 1; level <= kLevels; ++level) {
    const std::size_t shift = kShift * level;
    const std::size_t blocks = capacity_ >> shift;
    const bool first_of_block = (tick & ((std::uint64_t{1} << shift) - 1)) == 0;
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      MinMax& block = levels_[level - 1][channel * blocks + (at >> shift)];
      if (first_of_block) block = MinMax{};
      block.include(values[channel]);
    }
  }
  end_ = tick + 1;
}

float ChannelStore::value(std::size_t channel, std::uint64_t tick) const {
  if (tick < first_ || tick >= end_) return gap_[0];
  return samples_[channel * capacity_ + slot(tick)];
}

MinMax ChannelStore::min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  MinMax range;
  std::uint64_t tick = std::max(from, first_);
  const std::uint64_t end = std::min(to, end_);
  while (tick < end) {
    // The largest block that starts here and ends within the range: such a block lies wholly within what
    // is kept, so none of its ticks has been written over.
    std::size_t level = 0;
    while (level < kLevels) {
      const std::size_t shift = kShift * (level + 1);
      if ((tick & ((std::uint64_t{1} << shift) - 1)) != 0 || tick + (std::uint64_t{1} << shift) > end) break;
      ++level;
    }
    if (level == 0) {
      range.include(samples_[channel * capacity_ + slot(tick)]);
      ++tick;
      continue;
    }
    const std::size_t shift = kShift * level;
    range.include(levels_[level - 1][channel * (capacity_ >> shift) + (slot(tick) >> shift)]);
    tick += std::uint64_t{1} << shift;
  }
  return range;
}

}  // namespace tangent
