// By the pyramids: of 256 ticks each recording keeps the least and the most of every channel. Two sets of ticks that go
// together one by one differ in one of them at least by how far the one range is outside of the other, and nowhere by
// more than the two ranges are wide together.
#include "workbench/recording/compare_recordings.h"

#include "workbench/recording/compared_ticks.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr std::uint64_t kFineTicks = 8'000'000;  // over that, rows of 4,096 ticks are read

/// Range of each channel, and of the finger's three coordinates, over some ticks.
struct Ranges {
  static constexpr std::size_t kCount = kComparedChannelCount + 3;
  std::array<double, kCount> least, most;
  bool whole = true;  ///< no tick of them is missing
  std::uint64_t ticks = 0;

  Ranges() {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
  }
};

std::array<std::size_t, Ranges::kCount> places_in_overview() {
  std::array<std::size_t, Ranges::kCount> found{};
  const auto names = overview_channels();
  const auto place = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  for (std::size_t i = 0; i < kComparedChannelCount; ++i) found[i] = place(kComparedChannels[i]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    found[kComparedChannelCount + axis] = place(std::array{"finger_x_m", "finger_y_m", "finger_z_m"}[axis]);
  return found;
}

void include(Ranges& ranges, const OverviewRow& row, std::uint64_t length) {
  static const auto kPlaces = places_in_overview();
  for (std::size_t i = 0; i < Ranges::kCount; ++i) {
    ranges.least[i] = std::min(ranges.least[i], row.least[kPlaces[i]]);
    ranges.most[i] = std::max(ranges.most[i], row.most[kPlaces[i]]);
  }
  ranges.ticks += row.ticks;
  ranges.whole = ranges.whole && row.ticks == length;
}

/// Those of `rows` that touch the ticks.
Ranges ranges_over(const std::vector<OverviewRow>& rows, std::uint64_t first, std::uint64_t last,
                   std::uint64_t length) {
  Ranges out;
  auto row = std::lower_bound(rows.begin(), rows.end(), first / length * length,
                              [](const OverviewRow& r, std::uint64_t tick) { return r.first_tick < tick; });
  std::uint64_t reached = first / length * length;
  for (; row != rows.end() && row->first_tick <= last; ++row) {
    out.whole = out.whole && row->first_tick == reached;
    include(out, *row, length);
    reached = row->first_tick + length;
  }
  out.whole = out.whole && reached > last;
  return out;
}

struct Bounds {
  double at_least = 0.0, at_most = 0.0;
};

/// `each`: every tick of A goes with one of B; `only`: and the other way round.
Bounds bounds_of(const Ranges& a, const Ranges& b, std::size_t i, bool each, bool only) {
  Bounds out;
  out.at_most = std::max({0.0, a.most[i] - b.least[i], b.most[i] - a.least[i]});
  if (each) out.at_least = std::max({0.0, a.most[i] - b.most[i], b.least[i] - a.least[i]});
  if (each && only) out.at_least = std::max({out.at_least, b.most[i] - a.most[i], a.least[i] - b.least[i]});
  if (!std::isfinite(out.at_least) || !std::isfinite(out.at_most)) return {};
  return out;
}

class CoarseComparison {
 public:
  CoarseComparison(const Alignment& alignment, const CompareRecordingsOptions& options, int level)
      : options_(options), length_(overview_length(level)) {
    out_.alignment = alignment;
    out_.quantities = no_differences(options.tolerance);
    out_.bins = empty_bins(alignment, options.bins);
  }

  void add(const OverviewRow& row, const std::vector<OverviewRow>& rows_of_b) {
    const Alignment& with = out_.alignment;
    const std::uint64_t first = std::max(row.first_tick, with.first);
    const std::uint64_t last = std::min(row.first_tick + length_ - 1, with.last);
    if (last < first) return;
    Ranges a;
    include(a, row, length_);
    const Ranges b = ranges_over(rows_of_b, with.in_b(first), with.in_b(last), length_);
    if (b.ticks == 0) {
      out_.in_one_only += row.ticks;
      return;
    }
    const bool whole = last - first + 1 == length_;
    const bool each = whole && a.whole && b.whole, only = each && with.shift % static_cast<std::int64_t>(length_) == 0;
    judge(first, row.ticks, a, b, each, only);
  }

  RecordingsCompared done() {
    out_.outcome = outcome();
    if (out_.outcome == CompareOutcome::not_aligned)
      out_.why = "the fingers are further apart than the tolerance in " + std::to_string(out_.apart) + " of " +
                 std::to_string(out_.compared + out_.apart) + " ticks: these are other motions";
    return std::move(out_);
  }

 private:
  void judge(std::uint64_t first, std::uint64_t ticks, const Ranges& a, const Ranges& b, bool each, bool only) {
    double apart = 0.0;
    for (std::size_t i = kComparedChannelCount; i < Ranges::kCount; ++i)
      apart = std::max(apart, bounds_of(a, b, i, each, only).at_least);
    std::array<Bounds, kComparedChannelCount> bounds;
    for (std::size_t i = 0; i < kComparedChannelCount; ++i) bounds[i] = bounds_of(a, b, i, each, only);
    add_to_bin(first, ticks, a, b, bounds);
    if (apart > options_.tolerance.finger_m) {
      out_.apart += ticks;
      return;
    }
    out_.compared += ticks;
    for (std::size_t q = 0; q < kComparedQuantities.size(); ++q) {
      Bounds all;
      const ComparedQuantity& of = kComparedQuantities[q];
      for (std::size_t i = of.first; i < of.first + of.count; ++i) {
        all.at_least = std::max(all.at_least, bounds[i].at_least);
        all.at_most = std::hypot(all.at_most, bounds[i].at_most);
      }
      // The places of a contact that doesn't touch are not compared, and which those are isn't known here.
      if (q == kContactQuantity) all.at_least = 0.0;
      take(out_.quantities[q], all, first);
    }
  }

  static void take(QuantityDifference& d, const Bounds& bounds, std::uint64_t first) {
    if (d.judged() && bounds.at_least > d.tolerance) ++d.over;
    const bool worse = bounds.at_least > d.at_least || (d.at_least == 0.0 && bounds.at_most > d.at_most);
    if (worse) d.worst_tick = first;
    d.at_least = std::max(d.at_least, bounds.at_least);
    d.at_most = std::max(d.at_most, bounds.at_most);
  }

  void add_to_bin(std::uint64_t first, std::uint64_t ticks, const Ranges& a, const Ranges& b,
                  const std::array<Bounds, kComparedChannelCount>& bounds) {
    ComparedBin& bin = out_.bins[bin_of(out_.alignment, first, out_.bins.size())];
    bin.ticks += ticks;
    for (std::size_t i = 0; i < kComparedChannelCount; ++i) {
      bin.least_a[i] = std::min(bin.least_a[i], a.least[i]);
      bin.most_a[i] = std::max(bin.most_a[i], a.most[i]);
      bin.least_b[i] = std::min(bin.least_b[i], b.least[i]);
      bin.most_b[i] = std::max(bin.most_b[i], b.most[i]);
      bin.at_least[i] = std::max(bin.at_least[i], bounds[i].at_least);
      bin.at_most[i] = std::max(bin.at_most[i], bounds[i].at_most);
    }
  }

  CompareOutcome outcome() const {
    if (out_.apart > 0 && out_.compared <= out_.apart) return CompareOutcome::not_aligned;
    bool all_within = out_.compared > 0;
    for (const QuantityDifference& d : out_.quantities) {
      if (d.over > 0) return CompareOutcome::different;
      all_within = all_within && (!d.judged() || d.at_most <= d.tolerance);
    }
    return all_within ? CompareOutcome::same : CompareOutcome::undecided;
  }

  const CompareRecordingsOptions& options_;
  std::uint64_t length_;
  RecordingsCompared out_;
};

}  // namespace

Result<RecordingsCompared> compare_coarsely(const std::filesystem::path& a, const std::filesystem::path& b,
                                            const CompareRecordingsOptions& options) {
  Result<OpenedPair> pair = open_pair(a, b, options);
  if (!pair) return tl::unexpected(pair.error());
  const Alignment& alignment = pair->alignment;
  if (!alignment.aligned()) return not_aligned(alignment);
  const int level = alignment.ticks() > kFineTicks ? 1 : 0;
  const auto rows = pair->a.overview(level, alignment.first, alignment.last);
  if (!rows) return tl::unexpected(rows.error());
  const auto rows_of_b = pair->b.overview(level, alignment.in_b(alignment.first), alignment.in_b(alignment.last));
  if (!rows_of_b) return tl::unexpected(rows_of_b.error());
  CoarseComparison comparison(alignment, options, level);
  for (const OverviewRow& row : *rows) comparison.add(row, *rows_of_b);
  return comparison.done();
}

}  // namespace tangent
