// Times of two presets on the same motion, side by side: A, B, B, A, again and again, so that what the machine does
// besides falls on both. Said with an interval, and as a tie where the difference is not sure or not worth a word.
#pragma once

#include "core/tick/step.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tangent::sweep {

enum class TimeVerdict : std::uint8_t { tie, faster, slower };
inline constexpr std::array<std::string_view, 3> kVerdictNames{"tie", "faster", "slower"};

/// A ratio below this is a tie, however sure it is: 1 %.
inline constexpr double kNearTie = 0.01;

struct PairedTime {
  double ns = 0.0, against_ns = 0.0;          ///< a tick, medians over the rounds
  double ratio = 1.0, low = 1.0, high = 1.0;  ///< ns over against_ns: mean in the logarithm, and its 95 % interval
  std::uint64_t rounds = 0;
  TimeVerdict verdict = TimeVerdict::tie;  ///< of the first against the second
  std::optional<double> instructions;      ///< a tick, of the first; none: this machine does not count them
};

/// Of the time of single ticks, each read from the clock (which takes some 20 ns of both sides).
struct PairedTicks {
  PairedTime mean, p99;
};

/// One round: times of A, B, B, A. A and B in nanoseconds a tick.
using TimeRound = std::array<double, 4>;

/// From the rounds' log ratios, by Student's t: (ln A1 + ln A2 - ln B1 - ln B2) / 2 of a round is free of a drift that
/// is linear within it. Precondition: at least 2 rounds, all times above 0.
PairedTime judge(std::span<const TimeRound> rounds);

/// `motion`: the same ticks for both, from a fresh state. `stop`: asked between runs; empty: it said so.
std::optional<PairedTime> time_paired(const std::shared_ptr<const ContactScene>& scene, const Preset& a,
                                      const Preset& b, std::span<const TickInput> motion, std::size_t rounds,
                                      const std::function<bool()>& stop = {});

/// Likewise, the 99th percentile, too: from runs of their own, so that the clock is not in the mean.
std::optional<PairedTicks> time_paired_ticks(const std::shared_ptr<const ContactScene>& scene, const Preset& a,
                                             const Preset& b, std::span<const TickInput> motion, std::size_t rounds,
                                             const std::function<bool()>& stop = {});

}  // namespace tangent::sweep
