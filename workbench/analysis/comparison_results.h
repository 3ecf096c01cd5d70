// What a group's comparisons say (Doxon et al. 5.2.5, 5.2.6): thresholds, and whether conditions differ.
#pragma once

#include "core/lab/measure/interval.h"
#include "workbench/analysis/condition_order.h"
#include "workbench/analysis/group_tests.h"
#include "workbench/analysis/load_answers.h"
#include "workbench/analysis/psychometric_fit.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tangent::analysis {

/// One staircase.
struct StaircaseResult {
  std::string participant, condition;
  int trials = 0;
  std::vector<int> levels;         ///< segments, by trial
  std::vector<char> right;         ///< by trial
  std::vector<int> reversals;      ///< trials
  std::optional<double> segments;  ///< the rule's: mean of the last reversals; none: it did not settle
  FittedThreshold fitted;
  double rule_bias = 1.0;  ///< ThresholdFitter::rule_bias at the fitted threshold and the condition's common spread
  std::vector<std::string> warnings;  ///< staircase_warnings.h
};

/// All participants under one condition.
struct ConditionResult {
  std::string condition;
  std::vector<double> thresholds;  ///< segments, of those that settled, in the order of the participants
  std::size_t not_settled = 0;
  std::size_t warned = 0;  ///< staircases with a warning
  MeanInterval segments;   ///< mean and 95 % interval over participants
  /// Ends of that interval, cut at the fewest segments that are shown; not a number with fewer than two participants.
  double low = 0.0, high = 0.0;
  double degrees = 0.0;  ///< at the mean, and at those ends: fewer segments, more degrees
  double degrees_low = 0.0, degrees_high = 0.0;
  double mean_trials = 0.0;
  double rule_bias = 1.0;  ///< geometric mean of the staircases' that have one; NaN: none has
  SpreadInterval spread;   ///< of the psychometric function, all participants together
};

struct ComparisonResults {
  std::vector<StaircaseResult> staircases;  ///< participant by participant, conditions in the protocol's order
  std::vector<ConditionResult> conditions;
  std::optional<VarianceAnalysis> between;   ///< as the paper's: participants as independent
  std::optional<VarianceAnalysis> repeated;  ///< within participants; none where somebody lacks a condition
  std::vector<TukeyPair> pairs;              ///< of conditions, with the error of `between`
  std::optional<OrderAgreement> order;       ///< with the paper's Table 2
};

std::size_t staircases_with_warnings(const ComparisonResults& results);

/// `repeats`: staircases simulated for a calibration of the intervals. `stop`: asked at each of those, and between
/// the participants' own; none of the rest is there then.
ComparisonResults comparison_results(const std::vector<ParticipantAnswers<experiment::ComparisonRow>>& participants,
                                     int repeats, const std::function<bool()>& stop = {});

}  // namespace tangent::analysis
