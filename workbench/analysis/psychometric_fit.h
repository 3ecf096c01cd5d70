// The threshold of one staircase, with an interval that holds, by all psychometric functions that its answers allow.
//
// Some forty answers near one level say where the function is and next to nothing of its spread: the spread that is
// most likely is too small, by a factor of 0.2 to 0.9 (Kaernbach 2001 has the reason: levels hang on answers), and an
// interval with that spread is too short for participants whose function is wide. So none is chosen. Every function of
// a grid of middles, spreads and rates of lapses counts as much as the answers are likely under it; the threshold is
// the median of theirs. How far into the tails the interval goes, and how far the median lies off, is found by running
// the rule with simulated participants of all spreads from 0.1 to 1 (calibration: Beran 1987). The tail hangs on the
// spread that the answers suggest, ln(-ln tail) = c + 1.3 mean(ln spread), so that the interval holds for narrow and
// wide functions alike, which one tail for all does not: `workbench analyse --check` measures both.
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

/// Logarithm of how likely the answers are under each spread, all middles and lapses taken together.
using SpreadLikelihood = std::array<double, kSpreads>;

/// An estimate, and a 95 % interval that holds the truth at least so often.
struct SpreadInterval {
  double spread = 0.0, low = 0.0, high = 0.0;
};
/// The spread that several staircases share, each with a threshold of its own: by two priors, one of which takes wide
/// functions for wider, the other narrow ones for narrower. The interval reaches from the one's end to the other's.
/// Precondition: at least one.
SpreadInterval common_spread(std::span<const SpreadLikelihood> staircases);

struct FittedThreshold {
  double segments = 0.0;         ///< at the rule's balance point
  double low = 0.0, high = 0.0;  ///< its 95 % interval; at most a factor of 20 beyond the levels shown
  /// The rule's mean of reversals over the threshold, on average over simulated staircases like this one: 1 is no bias.
  double rule_bias = 1.0;
  SpreadLikelihood spreads{};
};

/// Fits staircases of one rule. What is found by simulation is found once for thresholds that are alike, and is the
/// same whatever was fitted before.
class ThresholdFitter {
 public:
  /// `simulated`: staircases for each calibration. Precondition: at least 20. `stop` is asked before each of
  /// them: once it says so, fits are of no use.
  explicit ThresholdFitter(const experiment::StaircaseRule& rule, int simulated = 1000, std::function<bool()> stop = {})
      : rule_(rule), simulated_(simulated), stop_(std::move(stop)) {}
  const experiment::StaircaseRule& rule() const { return rule_; }
  /// Precondition: at least one answer.
  FittedThreshold fit(std::span<const ComparisonAnswer> answers);

 private:
  /// Of staircases with one threshold; m: mean of ln(spread) by the answers.
  struct Calibration {
    double tail = 0.0;                     ///< c of the interval
    std::array<double, 2> off{0.0, 0.0};   ///< median of ln(threshold) less the truth: off[0] + off[1] m
    std::array<double, 2> rule{0.0, 0.0};  ///< ln(mean of reversals) less the truth, likewise
  };
  const Calibration& calibrated(int place);
  Calibration calibrate(double threshold) const;

  experiment::StaircaseRule rule_;
  int simulated_;
  std::function<bool()> stop_;
  std::map<int, Calibration> known_;  ///< by the logarithm, to base 2, of threshold over start
};

/// A staircase of a participant with this function, until it is done.
std::vector<ComparisonAnswer> simulated_answers(experiment::Staircase& staircase,
                                                const experiment::Psychometric& function, SplitMix& random);

}  // namespace tangent::analysis
