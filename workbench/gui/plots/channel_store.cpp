#include "workbench/gui/plots/channel_store.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstring>

namespace tangent {

namespace {

/// Thread-safe: stores are created in any thread.
std::uint64_t next_generation() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

// Four floats at a time (SIMD). The comparisons are written so that NaN leaves the range unchanged and each compiles to
// one instruction.
using Four = float __attribute__((vector_size(16)));

Four load(const void* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}
Four all(float value) { return Four{value, value, value, value}; }
Four lower(Four x, Four than) { return x < than ? x : than; }
Four higher(Four x, Four than) { return x > than ? x : than; }

/// Folds `items` lane by lane, as many per load as fit; returns how many were folded.
template <class Item>
std::size_t fold_lanes(const Item* items, std::size_t count, Four& low, Four& high) {
  constexpr std::size_t kAtOnce = sizeof(Four) / sizeof(Item);
  std::size_t i = 0;
  for (; i + kAtOnce <= count; i += kAtOnce) {
    const Four x = load(items + i);
    low = lower(x, low);
    high = higher(x, high);
  }
  return i;
}

void fold(const float* sample, std::size_t count, MinMax& into) {
  Four low = all(into.min), high = all(into.max);
  std::size_t i = fold_lanes(sample, count, low, high);
  for (std::size_t lane = 0; lane < 4; ++lane) into.include(MinMax{low[lane], high[lane]});
  for (; i < count; ++i) into.include(sample[i]);
}

/// Minima are in the even lanes, maxima in the odd ones.
void fold(const MinMax* block, std::size_t count, MinMax& into) {
  static_assert(sizeof(MinMax) == 2 * sizeof(float));
  Four low = all(into.min), high = all(into.max);
  const std::size_t i = fold_lanes(block, count, low, high);
  into.include(MinMax{low[0], high[1]});
  into.include(MinMax{low[2], high[3]});
  if (i < count) into.include(block[i]);
}

}  // namespace

ChannelStore::ChannelStore(std::size_t channels, std::size_t capacity)
    : channels_(channels), generation_(next_generation()), gap_(channels, std::numeric_limits<float>::quiet_NaN()) {
  static_assert(kLargestBlock == std::size_t{1} << shift_of(kLevels) && shift_of(kFirstSumLevel) == 6);
  assert(channels > 0);
  capacity_ = std::bit_ceil(std::max(capacity, static_cast<std::size_t>(kLargestBlock)));
  samples_ = std::make_unique_for_overwrite<float[]>(channels_ * capacity_);
  for (std::size_t level = 1; level <= kLevels; ++level) {
    levels_.emplace_back(channels_ * (capacity_ >> shift_of(level)));
    if (level >= kFirstSumLevel) sums_.emplace_back(channels_ * (capacity_ >> shift_of(level)));
  }
}

std::size_t ChannelStore::memory_bytes() const {
  std::size_t bytes = channels_ * capacity_ * sizeof(float);
  for (const auto& level : levels_) bytes += level.size() * sizeof(MinMax);
  for (const auto& level : sums_) bytes += level.size() * sizeof(SampleSums);
  return bytes;
}

void ChannelStore::set_coarse(Coarse coarse) {
  assert(coarse.blocks == nullptr || (coarse.blocks->channels() == 2 * channels_ && coarse.ticks > 0));
  coarse_ = std::move(coarse);
  generation_ = next_generation();
}

void ChannelStore::clear() {
  first_ = end_ = 0;
  generation_ = next_generation();
}

void ChannelStore::push(std::uint64_t tick, std::span<const float> values) {
  assert(values.size() == channels_);
  if (first_ != end_ && (tick < end_ || tick - end_ >= capacity_)) clear();
  if (first_ == end_) first_ = end_ = tick;
  while (end_ < tick) put(end_, gap_);
  put(tick, values);
  if (end_ - first_ > capacity_) first_ = end_ - capacity_;
}

void ChannelStore::drop_before(std::uint64_t tick) { first_ = std::clamp(tick, first_, end_); }

// A block is computed when its last tick is stored, and not read before.
void ChannelStore::put(std::uint64_t tick, std::span<const float> values) {
  const std::size_t at = slot(tick);
  for (std::size_t channel = 0; channel < channels_; ++channel) {
    samples_[channel * capacity_ + at] = values[channel];
  }
  end_ = tick + 1;
  for (std::size_t level = 1; level <= kLevels; ++level) {
    const std::uint64_t length = std::uint64_t{1} << shift_of(level);
    // A block that begins before the first tick is never read, nor any larger one.
    if (end_ % length != 0 || end_ - length < first_) return;
    for (std::size_t channel = 0; channel < channels_; ++channel) complete(level, channel, end_ - length);
  }
}

/// Computes a block from the level below.
void ChannelStore::complete(std::size_t level, std::size_t channel, std::uint64_t start) {
  const std::uint64_t half = std::uint64_t{1} << (shift_of(level) - 1);
  MinMax range;
  if (level == 1)
    fold(samples_.get() + place(0, channel, start), std::size_t{1} << kSmallestShift, range);
  else
    fold(&block(level - 1, channel, start), 2, range);
  block(level, channel, start) = range;
  if (level < kFirstSumLevel) return;
  SampleSums sums;
  if (level == kFirstSumLevel) {
    const float* sample = samples_.get() + place(0, channel, start);
    for (std::uint64_t i = 0; i < 2 * half; ++i) sums.include(sample[i]);
  } else {
    sums.include(sum_block(level - 1, channel, start));
    sums.include(sum_block(level - 1, channel, start + half));
  }
  sum_block(level, channel, start) = sums;
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

// Level by level, complete blocks only.
void ChannelStore::assign_channel(std::size_t channel, std::uint64_t first, std::span<const float> rows) {
  const std::uint64_t end = first + rows.size() / channels_;
  const float* value = rows.data() + channel;
  for (std::uint64_t tick = first; tick < end; ++tick, value += channels_)
    samples_[channel * capacity_ + slot(tick)] = *value;
  for (std::size_t level = 1; level <= kLevels; ++level) {
    const std::uint64_t length = std::uint64_t{1} << shift_of(level);
    for (std::uint64_t start = (first + length - 1) / length * length; start + length <= end; start += length)
      complete(level, channel, start);
  }
}

float ChannelStore::value(std::size_t channel, std::uint64_t tick) const {
  if (tick < first_ || tick >= end_) return gap_[0];
  return samples_[channel * capacity_ + slot(tick)];
}

// Calls visit(level, slot, count) for runs of adjacent blocks that together cover from <= tick < to, clipped to the
// kept ticks: up the levels to the largest blocks that fit, and down again. None of the ticks of a block inside the
// kept range has been overwritten. Level 0 holds the samples.
template <class Visit>
void ChannelStore::visit_blocks(std::uint64_t from, std::uint64_t to, Visit visit) const {
  std::uint64_t tick = std::max(from, first_);
  const std::uint64_t end = std::min(to, end_);
  std::size_t level = 0;
  while (tick < end) {
    const auto length = [](std::size_t of) { return std::uint64_t{1} << shift_of(of); };
    const auto fits = [&](std::size_t of) { return tick % length(of) == 0 && tick + length(of) <= end; };
    while (level < kLevels && fits(level + 1)) ++level;
    while (tick + length(level) > end) --level;
    // Up to the end, the start of a larger block, or the end of the ring, whichever comes first.
    const std::size_t shift = shift_of(level);
    const std::uint64_t block = tick >> shift, ring = capacity_ >> shift;
    std::uint64_t count = std::min((end - tick) >> shift, ring - (block & (ring - 1)));
    if (level < kLevels) {
      const std::uint64_t in_larger = length(level + 1) >> shift;
      count = std::min(count, in_larger - block % in_larger);
    }
    visit(level, static_cast<std::size_t>(block & (ring - 1)), static_cast<std::size_t>(count));
    tick += count << shift;
  }
}

MinMax ChannelStore::min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  if (!reaches_beyond(from, to)) return kept_min_max(channel, from, to);
  MinMax range = kept_min_max(channel, std::max(from, first_), std::max(first_, std::min(to, end_)));
  const bool any = first_ < end_;
  include_coarse(channel, from, any ? std::min(to, first_) : to, range);
  if (any) include_coarse(channel, std::max(from, end_), to, range);
  return range;
}

void ChannelStore::include_coarse(std::size_t channel, std::uint64_t from, std::uint64_t to, MinMax& range) const {
  from = std::max(from, coarse_.first);
  to = std::min(to, coarse_.end);
  if (from >= to) return;
  const std::uint64_t first = from / coarse_.ticks, end = (to - 1) / coarse_.ticks + 1;
  const MinMax least = coarse_.blocks->min_max(2 * channel, first, end);
  const MinMax most = coarse_.blocks->min_max(2 * channel + 1, first, end);
  range.include(MinMax{least.min, most.max});
}

MinMax ChannelStore::kept_min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  MinMax range;
  // Short ranges (zoomed in) are read sample by sample: finding blocks would take longer.
  constexpr std::uint64_t few = 16;
  if (from >= first_ && to <= end_ && to - from <= few && slot(from) + (to - from) <= capacity_) {
    fold(samples_.get() + place(0, channel, from), static_cast<std::size_t>(to - from), range);
    return range;
  }
  visit_blocks(from, to, [&](std::size_t level, std::size_t at, std::size_t count) {
    if (level == 0)
      fold(samples_.get() + channel * capacity_ + at, count, range);
    else
      fold(levels_[level - 1].data() + channel * (capacity_ >> shift_of(level)) + at, count, range);
  });
  return range;
}

// The reads of a row are adjacent on one level, and every range has the same number of blocks.
void ChannelStore::min_max_row(std::size_t channel, std::uint64_t from, std::uint64_t ticks,
                               std::span<MinMax> out) const {
  if (reaches_beyond(from, from + ticks * out.size())) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = min_max(channel, from + i * ticks, from + (i + 1) * ticks);
    return;
  }
  std::size_t level = 0;
  const auto aligned = [&](std::size_t of) { return ((from | ticks) & ((std::uint64_t{1} << shift_of(of)) - 1)) == 0; };
  while (level < kLevels && aligned(level + 1)) ++level;
  const std::size_t shift = shift_of(level), count = static_cast<std::size_t>(ticks >> shift),
                    ring = capacity_ >> shift;
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
  if (level == 0)
    fold_all(samples_.get() + channel * ring);
  else
    fold_all(levels_[level - 1].data() + channel * ring);
}

SampleSums ChannelStore::sums(std::size_t channel, std::uint64_t from, std::uint64_t to) const {
  SampleSums total;
  if (reaches_beyond(std::max(from, first_tick()), std::min(to, end_tick()))) return total;
  visit_blocks(from, to, [&](std::size_t level, std::size_t at, std::size_t count) {
    if (level < kFirstSumLevel) {
      const float* sample = samples_.get() + channel * capacity_ + (at << shift_of(level));
      for (std::size_t i = 0; i < count << shift_of(level); ++i) total.include(sample[i]);
      return;
    }
    const SampleSums* block = sums_[level - kFirstSumLevel].data() + channel * (capacity_ >> shift_of(level)) + at;
    for (std::size_t i = 0; i < count; ++i) total.include(block[i]);
  });
  return total;
}

}  // namespace tangent
