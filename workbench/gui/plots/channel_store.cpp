#include "workbench/gui/plots/channel_store.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>

namespace tangent {

namespace {

/// Stores are made on any thread.
std::uint64_t next_generation() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

float low_of(float value) { return value; }
float high_of(float value) { return value; }
float low_of(const MinMax& range) { return range.min; }
float high_of(const MinMax& range) { return range.max; }

/// A NaN fails both comparisons; written as choices they need no branches. Four at a time, because each has to wait for the
/// one before it.
template <class Item>
void fold(const Item* item, std::size_t count, MinMax& into) {
  std::array<float, 4> low, high;
  low.fill(into.min);
  high.fill(into.max);
  const auto take = [&](std::size_t lane, const Item& x) {
    low[lane] = low_of(x) < low[lane] ? low_of(x) : low[lane];
    high[lane] = high_of(x) > high[lane] ? high_of(x) : high[lane];
  };
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    for (std::size_t lane = 0; lane < 4; ++lane) take(lane, item[i + lane]);
  }
  for (; i < count; ++i) take(0, item[i]);
  for (std::size_t lane = 0; lane < 4; ++lane) into.include(MinMax{low[lane], high[lane]});
}

}  // namespace

ChannelStore::ChannelStore(std::size_t channels, std::size_t capacity)
    : channels_(channels), generation_(next_generation()), gap_(channels, std::numeric_limits<float>::quiet_NaN()) {
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

void ChannelStore::clear() {
  first_ = end_ = 0;
  generation_ = next_generation();
}

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
  clear();
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

// Calls visit(level, slot, count) for runs of blocks that lie side by side and together are from <= tick < to, cut to what is
// kept: up the levels to the largest that fit, and down again. A block that starts and ends within what is kept has had
// none of its ticks written over. Level 0 are the samples.
template <class Visit>
void ChannelStore::visit_blocks(std::uint64_t from, std::uint64_t to, Visit visit) const {
  std::uint64_t tick = std::max(from, first_);
  const std::uint64_t end = std::min(to, end_);
  std::size_t shift = 0;
  while (tick < end) {
    constexpr std::size_t top = kShift * kLevels;
    const auto fits = [&](std::size_t s) { return (tick & ((std::uint64_t{1} << s) - 1)) == 0 && tick + (std::uint64_t{1} << s) <= end; };
    while (shift < top && fits(shift + kShift)) shift += kShift;
    while (tick + (std::uint64_t{1} << shift) > end) shift -= kShift;
    // Up to the end, to where a larger block begins, and to the end of the ring.
    const std::uint64_t block = tick >> shift, ring = capacity_ >> shift;
    std::uint64_t count = std::min((end - tick) >> shift, ring - (block & (ring - 1)));
    if (shift < top) count = std::min(count, (std::uint64_t{1} << kShift) - (block & ((1u << kShift) - 1)));
    visit(shift / kShift, static_cast<std::size_t>(block & (ring - 1)), static_cast<std::size_t>(count));
    tick += count << shift;
  }
}

MinMax ChannelStore::min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  MinMax range;
  visit_blocks(from, to, [&](std::size_t level, std::size_t at, std::size_t count) {
    if (level == 0) fold(samples_.get() + channel * capacity_ + at, count, range);
    else fold(levels_[level - 1].data() + channel * (capacity_ >> (kShift * level)) + at, count, range);
  });
  return range;
}

// Side by side on one level, the reads of a row are one stream; and all its ranges have as many.
void ChannelStore::min_max_row(std::size_t channel, std::uint64_t from, std::uint64_t ticks, std::span<MinMax> out) const {
  std::size_t shift = 0;
  const auto aligned = [&](std::size_t s) { return ((from | ticks) & ((std::uint64_t{1} << s) - 1)) == 0; };
  while (shift < kShift * kLevels && aligned(shift + kShift)) shift += kShift;
  const std::size_t count = static_cast<std::size_t>(ticks >> shift), ring = capacity_ >> shift;
  const auto fold_all = [&](const auto* items) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::uint64_t begin = from + i * ticks;
      const std::size_t at = slot(begin) >> shift;
      if (begin < first_ || begin + ticks > end_ || at + count > ring) {
        out[i] = min_max(channel, begin, begin + ticks);
        continue;
      }
      out[i] = {};
      fold(items + at, count, out[i]);
    }
  };
  if (shift == 0) fold_all(samples_.get() + channel * ring);
  else fold_all(levels_[shift / kShift - 1].data() + channel * ring);
}

SampleSums ChannelStore::sums(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  SampleSums total;
  visit_blocks(from, to, [&](std::size_t level, std::size_t at, std::size_t count) {
    if (level < kFirstSumLevel) {
      const float* sample = samples_.get() + channel * capacity_ + (at << (kShift * level));
      for (std::size_t i = 0; i < count << (kShift * level); ++i) total.include(sample[i]);
      return;
    }
    const SampleSums* block = sums_[level - kFirstSumLevel].data() + channel * (capacity_ >> (kShift * level)) + at;
    for (std::size_t i = 0; i < count; ++i) total.include(block[i]);
  });
  return total;
}

}  // namespace tangent
