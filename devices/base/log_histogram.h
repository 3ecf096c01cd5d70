// Logarithmic histogram of durations: percentiles of millions of ticks in fixed memory.
// One thread adds; any thread reads.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tangent {

class LogHistogram {
 public:
  /// 16 bins per doubling: a percentile is accurate to 1/32 of its value, and exact below 16.
  static constexpr unsigned kSubBits = 4;
  static constexpr std::size_t kBins = (64 - kSubBits + 1) << kSubBits;

  /// Adding thread only. `value` in any unit, the same for all.
  void add(std::uint64_t value) noexcept {
    auto& bin = bins_[bin_of(value)];
    if (value < least_.load(std::memory_order_relaxed)) least_.store(value, std::memory_order_relaxed);
    if (value > largest_.load(std::memory_order_relaxed)) largest_.store(value, std::memory_order_relaxed);
    bin.store(bin.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  /// Smallest value that at least `share` (0 to 1) of the counts do not exceed, as the middle of its bin, but never
  /// below the least nor above the largest value added; of all counts the largest; 0 when empty. In the unit of the
  /// values added.
  double percentile(double share) const noexcept;
  std::uint64_t count() const noexcept;  ///< of all bins
  std::uint64_t count_in(std::size_t bin) const noexcept { return bins_[bin].load(std::memory_order_relaxed); }

  /// Index of the bin that counts `value`, below kBins.
  static constexpr std::size_t bin_of(std::uint64_t value) noexcept {
    constexpr std::uint64_t kExact = 1u << kSubBits;
    if (value < kExact) return static_cast<std::size_t>(value);
    const unsigned shift = static_cast<unsigned>(std::bit_width(value)) - 1 - kSubBits;
    return ((static_cast<std::size_t>(shift) + 1) << kSubBits) + static_cast<std::size_t>((value >> shift) - kExact);
  }
  /// Smallest value of a bin. Precondition: bin < kBins.
  static constexpr std::uint64_t bottom_of(std::size_t bin) noexcept { return bin == 0 ? 0 : top_of(bin - 1) + 1; }
  /// Largest value of a bin. Precondition: bin < kBins.
  static constexpr std::uint64_t top_of(std::size_t bin) noexcept {
    constexpr std::uint64_t kExact = 1u << kSubBits;
    if (bin < kExact) return bin;
    const std::size_t shift = (bin >> kSubBits) - 1;
    return (((bin & (kExact - 1)) + kExact) << shift) + ((std::uint64_t{1} << shift) - 1);
  }

 private:
  std::array<std::atomic<std::uint64_t>, kBins> bins_{};
  std::atomic<std::uint64_t> least_{std::numeric_limits<std::uint64_t>::max()}, largest_{0};
};

}  // namespace tangent
