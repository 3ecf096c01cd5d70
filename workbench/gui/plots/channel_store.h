// Recent ticks as channels of one float per tick, with exact minima and maxima over any range of ticks.
//
// A ring indexed by tick with a pyramid of block minima and maxima (blocks of 8, 16, 32 ... ticks), so that a column of
// pixels takes about a dozen reads for any number of ticks, and a spike of one sample is visible at every zoom. Blocks
// of 64 ticks and more also store sums and sums of squares, for the mean and RMS of any range. Missing ticks are gaps:
// NaN. Not thread-safe.
//
// A recording of hours is a store that keeps the ticks around those in view, and knows all others coarsely: minima and
// maxima of blocks of ticks (set_coarse).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace tangent {

/// Over the samples present; empty() if there are none.
struct MinMax {
  float min = std::numeric_limits<float>::infinity();
  float max = -std::numeric_limits<float>::infinity();
  bool empty() const { return min > max; }
  void include(float v) {
    // A NaN fails both comparisons and leaves the range as it was.
    if (v < min) min = v;
    if (v > max) max = v;
  }
  void include(const MinMax& other) {
    if (other.min < min) min = other.min;
    if (other.max > max) max = other.max;
  }
};

/// Over the samples present. RMS is about zero, not about the mean.
struct SampleSums {
  double sum = 0.0, squares = 0.0;
  std::uint64_t count = 0;
  void include(float v) {
    if (std::isnan(v)) return;
    const double x = static_cast<double>(v);
    sum += x;
    squares += x * x;
    ++count;
  }
  void include(const SampleSums& other) {
    sum += other.sum;
    squares += other.squares;
    count += other.count;
  }
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : std::nan(""); }
  double rms() const { return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : std::nan(""); }
};

class ChannelStore {
 public:
  /// Ticks of the largest block.
  static constexpr double kLargestBlock = 262'144.0;

  /// Keeps `capacity` ticks, rounded up to a power of two, at least one largest block. Precondition: channels > 0.
  ChannelStore(std::size_t channels, std::size_t capacity);

  std::size_t channels() const { return channels_; }
  std::size_t capacity() const { return capacity_; }
  std::size_t memory_bytes() const;

  /// Appends tick `tick`. Ticks skipped since the last one become gaps. A tick number that does not increase (a new
  /// run) clears the store first. Precondition: values.size() == channels().
  void push(std::uint64_t tick, std::span<const float> values);
  void clear();
  /// Forgets the ticks before `tick`. What is left keeps its generation().
  void drop_before(std::uint64_t tick);
  /// Replaces the contents by `rows` (channels() values per tick, NaN for gaps) from tick `first` on; much faster than
  /// push. Keeps the newest capacity() ticks.
  void assign(std::uint64_t first, std::span<const float> rows);

  /// Ticks known coarsely, `first` to `end` - 1, among them those kept. The channels 2c and 2c + 1 of `blocks` are the
  /// least and the largest value of channel c, and its ticks are blocks: n holds the ticks n * ticks to (n + 1) *
  /// ticks.
  struct Coarse {
    std::shared_ptr<const ChannelStore> blocks;
    std::uint64_t ticks = 1, first = 0, end = 0;
  };
  /// For ranges that reach beyond the ticks kept; they are rounded out to whole blocks there. Values and sums are known
  /// of kept ticks alone. Null blocks: none.
  void set_coarse(Coarse coarse);

  bool empty() const { return first_tick() == end_tick(); }
  /// Identifies the contents, uniquely over all stores. While it is unchanged, ticks already present don't change:
  /// newer ones are appended and the oldest dropped.
  std::uint64_t generation() const { return generation_; }
  std::uint64_t first_tick() const { return coarse_.blocks ? coarse_.first : first_; }  ///< oldest known
  std::uint64_t end_tick() const { return coarse_.blocks ? coarse_.end : end_; }        ///< one past the newest
  std::uint64_t first_kept() const { return first_; }
  std::uint64_t end_kept() const { return end_; }

  /// NaN for a gap and outside the kept ticks.
  float value(std::size_t channel, std::uint64_t tick) const;
  /// Over from <= tick < to, clipped to the ticks known.
  MinMax min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const;
  /// The same for out.size() consecutive ranges of `ticks` ticks each, starting at `from`. Fastest where `ticks` and
  /// `from` are multiples of a block, 8 to 15 blocks per range.
  void min_max_row(std::size_t channel, std::uint64_t from, std::uint64_t ticks, std::span<MinMax> out) const;
  /// Empty where the range reaches beyond the ticks kept, and coarse ones are known.
  SampleSums sums(std::size_t channel, std::uint64_t from, std::uint64_t to) const;

 private:
  // Level 0 holds the samples; above the smallest block size each block covers two of the level below. With larger
  // ratios columns just short of the next level would read several times as many blocks as the others.
  static constexpr std::size_t kLevels = 16, kSmallestShift = 3;
  static constexpr std::size_t shift_of(std::size_t level) { return level == 0 ? 0 : kSmallestShift + level - 1; }
  static constexpr std::size_t kFirstSumLevel = 4;

  void put(std::uint64_t tick, std::span<const float> values);
  void complete(std::size_t level, std::size_t channel, std::uint64_t start);
  void assign_channel(std::size_t channel, std::uint64_t first, std::span<const float> rows);
  std::size_t slot(std::uint64_t tick) const { return static_cast<std::size_t>(tick) & (capacity_ - 1); }
  std::size_t place(std::size_t level, std::size_t channel, std::uint64_t tick) const {
    return channel * (capacity_ >> shift_of(level)) + (slot(tick) >> shift_of(level));
  }
  MinMax& block(std::size_t level, std::size_t channel, std::uint64_t tick) {
    return levels_[level - 1][place(level, channel, tick)];
  }
  SampleSums& sum_block(std::size_t level, std::size_t channel, std::uint64_t tick) {
    return sums_[level - kFirstSumLevel][place(level, channel, tick)];
  }
  bool reaches_beyond(std::uint64_t from, std::uint64_t to) const {
    return coarse_.blocks != nullptr && (from < first_ || to > end_);
  }
  MinMax kept_min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const;
  void include_coarse(std::size_t channel, std::uint64_t from, std::uint64_t to, MinMax& range) const;
  template <class Visit>
  void visit_blocks(std::uint64_t from, std::uint64_t to, Visit visit) const;

  std::size_t channels_ = 0, capacity_ = 0;
  std::uint64_t first_ = 0, end_ = 0, generation_ = 0;
  std::unique_ptr<float[]> samples_;           ///< [channel][slot]; pages are touched as it fills
  std::vector<std::vector<MinMax>> levels_;    ///< [level - 1][channel][block]
  std::vector<std::vector<SampleSums>> sums_;  ///< [level - kFirstSumLevel][channel][block]
  std::vector<float> gap_;
  Coarse coarse_;
};

}  // namespace tangent
