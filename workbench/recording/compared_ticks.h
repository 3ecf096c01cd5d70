// Ticks that are compared: where they come from, and what is counted of them.
#pragma once

#include "workbench/recording/compare_recordings.h"

#include <memory>
#include <optional>

namespace tangent {

struct ComparedTick {
  std::uint64_t tick = 0;
  TickStatus status = TickStatus::unconverged;
  Vec3 finger{0.0};
  ComparedBin::Values values{};
};

/// Ticks in order.
class ComparedTicks {
 public:
  virtual ~ComparedTicks() = default;
  virtual Result<bool> next(ComparedTick& tick) = 0;  ///< false: there is no further one
};

/// As they were recorded.
Result<std::unique_ptr<ComparedTicks>> recorded_ticks(const std::filesystem::path& path, std::uint64_t first,
                                                      std::uint64_t last);
struct TickSpan {
  std::uint64_t first = 0, last = 0;
};
/// Solved under another preset from the first tick on, and given from `span.first` on. Cancelled it ends.
Result<std::unique_ptr<ComparedTicks>> solved_ticks(const std::filesystem::path& path, const OtherPreset& how,
                                                    const TickSpan& span, std::function<bool()> cancelled);

// What is compared, and by which tolerance.
struct ComparedQuantity {
  std::string_view name, unit;
  std::size_t first, count;  ///< of kComparedChannels
  double CompareTolerance::*tolerance;
};
inline constexpr std::array<ComparedQuantity, 6> kComparedQuantities{
    {{"force", "N", 0, 3, &CompareTolerance::force_n},
     {"display", "m", 3, 1, &CompareTolerance::length_m},
     {"contact", "m", 4, 3, &CompareTolerance::length_m},
     {"penetration", "m", 7, 1, &CompareTolerance::length_m},
     {"error", "m", 8, 1, nullptr},
     {"iterations", "1", 9, 1, nullptr}}};
inline constexpr std::size_t kContactQuantity = 2;
/// With names, units and tolerances, and no differences.
std::vector<QuantityDifference> no_differences(const CompareTolerance& tolerance);

/// Counts pairs of ticks, in any order of theirs.
class PairCounter {
 public:
  PairCounter(const Alignment& alignment, const CompareRecordingsOptions& options);
  void add(const ComparedTick& a, const ComparedTick& b);
  void add_single() { ++out_.in_one_only; }
  void join(const PairCounter& other);
  /// With means and outcome. Call once, last.
  RecordingsCompared done();

 private:
  void add_curves(const ComparedTick& a, const ComparedTick& b, bool together);
  void add_spectra(const ComparedTick& a, const ComparedTick& b);
  CompareOutcome outcome() const;
  CompareTolerance tolerance_;
  RecordingsCompared out_;
  SpectrumCounter spectrum_a_, spectrum_b_;
  std::optional<std::uint64_t> last_;  ///< tick of A that was added last
};

/// The bin of a tick.
std::size_t bin_of(const Alignment& alignment, std::uint64_t tick, std::size_t bins);
std::vector<ComparedBin> empty_bins(const Alignment& alignment, std::size_t most);
/// The part of the alignment that the options ask for; empty, with the reason, where there is none.
Alignment narrowed(Alignment alignment, const CompareRecordingsOptions& options);
RecordingsCompared not_aligned(const Alignment& alignment);

/// Two recordings, opened, and what goes together of them, narrowed as above.
struct OpenedPair {
  Recording a, b;
  Alignment alignment;
};
Result<OpenedPair> open_pair(const std::filesystem::path& a, const std::filesystem::path& b,
                             const CompareRecordingsOptions& options);

}  // namespace tangent
