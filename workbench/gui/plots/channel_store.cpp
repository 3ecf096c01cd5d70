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
  samples_ = std::make_unique_for_overwrite<float[]>(channels_ * capacity_);
  for (std::size_t level = 1; level <= kLevels; ++level) {
    levels_.emplace_back(channels_ * (capacity_ >> (kShift * level)));
    if (level >= kFirstSumLevel) sums_.emplace_back(channels_ * (capacity_ >> (kShift * level)));
  }
}

std::size_t ChannelStore::memory_bytes() const {
  std::size_t bytes = channels_ * capacity_ * sizeof(float);
  for (const auto& level : levels_) bytes += level.size() * sizeof(MinMax);
  for (const auto& level : sums_) bytes += level.size() * sizeof(SampleSums);
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
    const bool first_of_block = (tick & ((std::uint64_t{1} << (kShift * level)) - 1)) == 0;
    for (std::size_t channel = 0; channel < channels_; ++channel) {
      MinMax& range = block(level, channel, tick);
      if (first_of_block) range = MinMax{};
      range.include(values[channel]);
      if (level < kFirstSumLevel) continue;
      SampleSums& sums = sum_block(level, channel, tick);
      if (first_of_block) sums = SampleSums{};
      sums.include(values[channel]);
    }
  }
  end_ = tick + 1;
}

void ChannelStore::assign(std::uint64_t first, std::span<const float> rows) {
  assert(rows.size() % channels_ == 0);
  std::size_t count = rows.size() / channels_;
  if (count > capacity_) {
    rows = rows.subspan((count - capacity_) * channels_);
    first += count - capacity_;
    count = capacity_;
  }
  first_ = first;
  end_ = first + count;
  for (std::size_t channel = 0; channel < channels_; ++channel) assign_channel(channel, first, rows);
}

// Level by level: each block from the blocks below it that lie within what is kept.
void ChannelStore::assign_channel(std::size_t channel, std::uint64_t first, std::span<const float> rows) {
  const std::uint64_t end = first + rows.size() / channels_;
  const float* value = rows.data() + channel;
  for (std::uint64_t tick = first; tick < end; ++tick, value += channels_) samples_[channel * capacity_ + slot(tick)] = *value;
  for (std::size_t level = 1; level <= kLevels; ++level) {
    const std::uint64_t length = std::uint64_t{1} << (kShift * level), part = length >> kShift;
    for (std::uint64_t start = first - first % length; start < end; start += length) {
      MinMax range;
      SampleSums sums;
      const std::uint64_t from = std::max(start, first - first % part), to = std::min(start + length, end);
      for (std::uint64_t tick = from; tick < to; tick += part) {
        if (level == 1) {
          if (tick >= first) range.include(samples_[channel * capacity_ + slot(tick)]);
          continue;
        }
        range.include(block(level - 1, channel, tick));
        if (level > kFirstSumLevel) sums.include(sum_block(level - 1, channel, tick));
      }
      block(level, channel, start) = range;
      if (level < kFirstSumLevel) continue;
      if (level == kFirstSumLevel) {
        for (std::uint64_t tick = std::max(start, first); tick < to; ++tick) sums.include(samples_[channel * capacity_ + slot(tick)]);
      }
      sum_block(level, channel, start) = sums;
    }
  }
}

float ChannelStore::value(std::size_t channel, std::uint64_t tick) const {
  if (tick < first_ || tick >= end_) return gap_[0];
  return samples_[channel * capacity_ + slot(tick)];
}

// A block that starts and ends within what is kept has had none of its ticks written over.
std::size_t ChannelStore::level_at(std::uint64_t tick, std::uint64_t end) {
  std::size_t level = 0;
  while (level < kLevels) {
    const std::uint64_t length = std::uint64_t{1} << (kShift * (level + 1));
    if ((tick & (length - 1)) != 0 || tick + length > end) break;
    ++level;
  }
  return level;
}

MinMax ChannelStore::min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  MinMax range;
  std::uint64_t tick = std::max(from, first_);
  const std::uint64_t end = std::min(to, end_);
  while (tick < end) {
    const std::size_t level = level_at(tick, end);
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

SampleSums ChannelStore::sums(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  SampleSums total;
  std::uint64_t tick = std::max(from, first_);
  const std::uint64_t end = std::min(to, end_);
  while (tick < end) {
    const std::size_t level = level_at(tick, end);
    if (level < kFirstSumLevel) {
      total.include(samples_[channel * capacity_ + slot(tick)]);
      ++tick;
      continue;
    }
    const std::size_t shift = kShift * level;
    total.include(sums_[level - kFirstSumLevel][channel * (capacity_ >> shift) + (slot(tick) >> shift)]);
    tick += std::uint64_t{1} << shift;
  }
  return total;
}

}  // namespace tangent
