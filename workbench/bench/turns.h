// What takes turns meets the same machine: a round runs every competitor once over the whole motion, in an order drawn
// anew, and times are compared within rounds.
#pragma once

#include "core/lab/measure/interval.h"
#include "workbench/bench/tick_clock.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tangent::bench {

using Stop = std::function<bool()>;  ///< polled now and then; true ends the work early

/// Times of every tick of one pass, ns. Empty: stopped.
using TimedPass = std::function<std::vector<double>()>;

/// Of one competitor, a value a round.
struct RoundTimes {
  std::vector<double> mean_ns, p50_ns, p99_ns;
  std::vector<double> typical_ns;  ///< middle mean (between the quartiles), at least 0.1: what ratios use
};

/// Medians over the rounds, with intervals by order statistics.
struct TickTimes {
  MedianInterval mean_ns, p50_ns, p99_ns, typical_ns;
};
TickTimes times_of(const RoundTimes& rounds);

struct TurnsOptions {
  std::uint64_t seed = 1;
  /// A round runs its order and then the reverse, and takes of each tick the lesser of both times: a tick during which
  /// the machine did something else does not count, and a drift falls on all.
  bool there_and_back = false;
  bool keep_least = false;  ///< of every tick the least time of all rounds
};

class Turns {
 public:
  explicit Turns(std::vector<TimedPass> passes, const TurnsOptions& options = {});
  /// False: stopped; what the round had so far is dropped.
  bool round();
  int rounds() const { return rounds_; }
  const RoundTimes& of(std::size_t competitor) const { return times_[competitor]; }
  /// Precondition: keep_least, and a round.
  const std::vector<double>& least_ns(std::size_t competitor) const { return least_ns_[competitor]; }
  /// Polled after each competitor of a round.
  std::function<void()> after_pass = [] {};

 private:
  std::vector<std::size_t> order();
  bool run(std::size_t competitor, std::vector<double>& least);

  std::vector<TimedPass> passes_;
  std::vector<RoundTimes> times_;
  std::vector<std::vector<double>> least_ns_;
  TurnsOptions options_;
  std::uint64_t random_;
  int rounds_ = 0;
};

/// A competitor is called a tie where it takes less than this over the fastest, or may, within the interval.
inline constexpr double kTieRatio = 1.03;

/// Beside the fastest of the same rounds.
struct BesideFastest {
  std::size_t competitor = 0;
  RatioInterval to_fastest;
  bool tie = false;  ///< not of the fastest itself
};
/// The competitors named, by typical time, the fastest first. Precondition: a round.
std::vector<BesideFastest> ranked(const Turns& turns, std::span<const std::size_t> competitors);

}  // namespace tangent::bench
