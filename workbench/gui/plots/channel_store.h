// The recent past as channels of one float per tick, with exact minima and maxima over any range of ticks.
//
// A ring over tick numbers with a pyramid of block minima and maxima (blocks of 8, 64, 512 ... ticks), so
// that a column of pixels costs a few dozen reads however many ticks lie under it, and a spike of one
// sample shows at every zoom. Ticks that never came are gaps: NaN.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tangent {

/// Of the samples that are there; none: empty().
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

class ChannelStore {
 public:
  /// `capacity` ticks are kept, rounded up to a power of two, the largest block's at least. Precondition:
  /// channels > 0.
  ChannelStore(std::size_t channels, std::size_t capacity);

  std::size_t channels() const { return channels_; }
  std::size_t capacity() const { return capacity_; }
  std::size_t memory_bytes() const;

  /// Appends tick `tick`. Ticks left out since the last one become gaps. A tick that isn't after the last
  /// one (another recording) starts the store anew. Precondition: values.size() == channels().
  void push(std::uint64_t tick, std::span<const float> values);
  void clear();

  bool empty() const { return first_ == end_; }
  std::uint64_t first_tick() const { return first_; }  ///< oldest kept
  std::uint64_t end_tick() const { return end_; }      ///< one past the newest

  /// NaN for a gap and outside what is kept.
  float value(std::size_t channel, std::uint64_t tick) const;
  /// Over from <= tick < to, cut to what is kept.
  MinMax min_max(std::size_t channel, std::uint64_t from, std::uint64_t to) const;

 private:
  static constexpr std::size_t kShift = 3;  ///< each level's block is 2^kShift blocks of the level below
  static constexpr std::size_t kLevels = 6;

  void put(std::uint64_t tick, std::span<const float> values);
  std::size_t slot(std::uint64_t tick) const { return static_cast<std::size_t>(tick) & (capacity_ - 1); }

  std::size_t channels_ = 0, capacity_ = 0;
  std::uint64_t first_ = 0, end_ = 0;
  std::vector<float> samples_;                ///< [channel][slot]
  std::vector<std::vector<MinMax>> levels_;   ///< [level][channel][block]
  std::vector<float> gap_;
};

}  // namespace tangent
