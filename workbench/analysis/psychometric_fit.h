// The threshold of one staircase, with an interval that holds, by all psychometric functions that its answers allow.
//
// Some forty answers near one level say where the function is and next to nothing of its spread: the spread that is
// most likely is too small, by a factor of 0.2 to 0.9 (Kaernbach 2001 has the reason: levels hang on answers), and an
// interval with that spread is too short for participants whose function is wide. So none is chosen. Every function of
// a grid of middles, spreads and rates of lapses counts as much as the answers are likely under it; the threshold is
// the median of theirs. How far into the tails the interval goes, and how far the median lies off, is found by running
// the rule with simulated participants of all spreads from 0.1 to 1 (calibration: Beran 1987), either end by itself.
// The ends hang on the spread that the answers suggest, on how far the threshold is from the start, and on how coarse
// segments are there, so that the interval holds for narrow and wide functions alike, which one tail for all does not:
// `workbench analyse --check` measures it. The spread that several staircases share is the one whose simulated groups
// have, as their median, the mean of ln(spread) that was found, and its interval are those that have it among their
// middle 95 % (Neyman 1937).
#pragma once

#include "core/base/split_mix.h"
#include "workbench/experiment/psychometric.h"
#include "workbench/experiment/staircase.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace tangent::analysis {

struct ComparisonAnswer {
  double segments = 0.0;
  bool right = false;
};

/// Rates of lapses that are tried, each as likely as the others.
inline constexpr std::array<double, 3> kLapses{0.0, 0.02, 0.06};
/// Spreads that are tried: so many from narrowest to widest, evenly in their logarithm.
inline constexpr std::size_t kSpreads = 16;
inline constexpr double kNarrowestSpread = 0.05, kWidestSpread = 2.0;
double spread_at(std::size_t i);

/// An estimate, and its 95 % interval; all within the spreads that are tried.
struct SpreadInterval {
  double spread = 0.0, low = 0.0, high = 0.0;
};
struct FittedThreshold {
  double segments = 0.0;         ///< at the rule's balance point
  double low = 0.0, high = 0.0;  ///< its 95 % interval; at most a factor of 20 beyond the levels shown
  double mean_log_spread = 0.0;  ///< by the answers: of staircases' answers too low or high (common_spread)
};

/// Fits staircases of one rule. What is found by simulation is found once for thresholds that are alike, and is the
/// same whatever was fitted before.
class ThresholdFitter {
 public:
  /// `simulated`: staircases for each calibration. Precondition: at least 20. `stop` is asked before each of
  /// them: once it says so, fits are of no use.
  explicit ThresholdFitter(const experiment::StaircaseRule& rule, int simulated = 4000, std::function<bool()> stop = {})
      : rule_(rule), simulated_(simulated), stop_(std::move(stop)) {}
  const experiment::StaircaseRule& rule() const { return rule_; }
  /// Precondition: at least one answer.
  FittedThreshold fit(std::span<const ComparisonAnswer> answers);
  /// The spread that several staircases of the rule share, each with a threshold of its own.
  /// Precondition: at least one.
  SpreadInterval common_spread(std::span<const FittedThreshold> staircases);
  /// The rule's mean of reversals over the threshold, geometric mean of simulated staircases with this threshold and
  /// spread: 1 is no bias, NaN that none settled. One staircase does not tell its spread: give several's common one.
  double rule_bias(double segments, double spread) const;

 private:
  /// Of staircases with one threshold; m: mean of ln(spread) by the answers.
  struct Calibration {
    double low = 0.0, high = 0.0;         ///< c of the interval's ends
    std::array<double, 2> off{0.0, 0.0};  ///< median of ln(threshold) less the truth: off[0] + off[1] m
  };
  /// mean_log_spread of simulated staircases of one threshold, by spread.
  using Pools = std::vector<std::vector<double>>;

  const Calibration& calibrated(int place);
  Calibration calibrate(double threshold) const;
  const Pools& pools(int place);
  std::vector<double> pool_of(int place, std::size_t spread) const;
  /// To base 2, of segments over the start; within what can be shown.
  double octaves_up(double log_segments) const;
  double threshold_at(int place) const;

  experiment::StaircaseRule rule_;
  int simulated_;
  std::function<bool()> stop_;
  // By the logarithm, to base 2, of threshold over start.
  std::map<int, Calibration> known_;
  std::map<int, Pools> pools_;
};

/// A staircase of a participant with this function, until it is done.
std::vector<ComparisonAnswer> simulated_answers(experiment::Staircase& staircase,
                                                const experiment::Psychometric& function, SplitMix& random);

}  // namespace tangent::analysis
