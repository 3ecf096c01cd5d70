#include "workbench/analysis/comparison_results.h"

#include "core/base/units.h"
#include "workbench/analysis/staircase_warnings.h"

#include <algorithm>
#include <cmath>

namespace tangent::analysis {
namespace {

using experiment::ComparisonCondition;
using experiment::ComparisonRow;
using experiment::Staircase;
using Comparer = ParticipantAnswers<ComparisonRow>;

double degrees_at(const experiment::Discrimination& design, double segments) {
  const double angles = design.placement == ArcPlacement::tangent ? segments - 1.0 : segments;
  return angles > 0.0 ? design.angle_rad / angles / kDegree : std::nan("");
}

/// None where the participant has not begun it.
std::optional<StaircaseResult> staircase_of(const Comparer& participant, const ComparisonCondition& condition,
                                            ThresholdFitter& fitter) {
  StaircaseResult out;
  out.participant = participant.name();
  out.condition = condition.name;
  Staircase staircase(condition.staircase);
  std::vector<ComparisonAnswer> answers;
  for (const ComparisonRow& row : participant.rows) {
    if (row.condition != condition.name) continue;
    if (staircase.answer(row.right)) out.reversals.push_back(out.trials);
    ++out.trials;
    out.levels.push_back(row.segments);
    out.right.push_back(row.right ? 1 : 0);
    answers.push_back({static_cast<double>(row.segments), row.right});
  }
  if (answers.empty()) return std::nullopt;
  if (staircase.settled()) {  // of what was shown: versions before stepped otherwise
    double sum = 0.0;
    for (auto at = out.reversals.end() - condition.staircase.averaged; at != out.reversals.end(); ++at)
      sum += out.levels[static_cast<std::size_t>(*at)];
    out.segments = sum / condition.staircase.averaged;
  }
  out.fitted = fitter.fit(answers);
  out.warnings = staircase_warnings(out, condition.staircase);
  return out;
}

ConditionResult condition_of(const ComparisonCondition& condition, const experiment::Discrimination& design,
                             std::vector<StaircaseResult>& staircases, ThresholdFitter& fitter) {
  ConditionResult out;
  out.condition = condition.name;
  double trials = 0.0, count = 0.0;
  std::vector<FittedThreshold> fits;
  for (const StaircaseResult& one : staircases) {
    if (one.condition != condition.name) continue;
    count += 1.0;
    out.warned += !one.warnings.empty();
    trials += one.trials;
    fits.push_back(one.fitted);
    if (one.segments)
      out.thresholds.push_back(*one.segments);
    else
      ++out.not_settled;
  }
  if (count > 0.0) {
    out.mean_trials = trials / count;
    out.spread = fitter.common_spread(fits);
    double bias = 0.0, told = 0.0;
    for (StaircaseResult& one : staircases) {
      if (one.condition != condition.name) continue;
      one.rule_bias = fitter.rule_bias(one.fitted.segments, out.spread.spread);
      if (std::isnan(one.rule_bias)) continue;
      told += 1.0;
      bias += std::log(one.rule_bias);
    }
    out.rule_bias = told > 0.0 ? std::exp(bias / told) : std::nan("");
  }
  out.segments = mean_interval(out.thresholds);
  if (out.thresholds.empty()) return out;
  const bool some = std::isfinite(out.segments.half);
  out.low = some ? std::max(out.segments.low(), condition.staircase.fewest) : std::nan("");
  out.high = some ? out.segments.high() : std::nan("");
  out.degrees = degrees_at(design, out.segments.mean);
  out.degrees_low = degrees_at(design, out.high);
  out.degrees_high = degrees_at(design, out.low);
  return out;
}

/// By condition and participant; NaN: did not settle.
std::vector<std::vector<double>> all_thresholds(const std::vector<std::string>& conditions,
                                                const std::vector<Comparer>& participants,
                                                const std::vector<StaircaseResult>& staircases) {
  std::vector<std::vector<double>> out(conditions.size(), std::vector<double>(participants.size(), std::nan("")));
  for (const StaircaseResult& one : staircases)
    for (std::size_t c = 0; c < conditions.size(); ++c)
      for (std::size_t p = 0; p < participants.size(); ++p)
        if (one.condition == conditions[c] && one.participant == participants[p].name() && one.segments)
          out[c][p] = *one.segments;
  return out;
}

}  // namespace

std::size_t staircases_with_warnings(const ComparisonResults& results) {
  return static_cast<std::size_t>(std::count_if(results.staircases.begin(), results.staircases.end(),
                                                [](const StaircaseResult& one) { return !one.warnings.empty(); }));
}

ComparisonResults comparison_results(const std::vector<Comparer>& participants, int repeats,
                                     const std::function<bool()>& stop) {
  ComparisonResults out;
  if (participants.empty()) return out;
  const experiment::Discrimination& design = *participants.front().protocol.discrimination();
  std::vector<ThresholdFitter> fitters;  // conditions of one rule share what is found by simulation
  const auto fitter_of = [&](const experiment::StaircaseRule& rule) -> ThresholdFitter& {
    const auto of_rule = [&](const ThresholdFitter& f) { return f.rule() == rule; };
    const auto fitter = std::find_if(fitters.begin(), fitters.end(), of_rule);
    return fitter == fitters.end() ? fitters.emplace_back(rule, repeats, stop) : *fitter;
  };
  for (const Comparer& participant : participants) {
    for (const ComparisonCondition& condition : design.conditions) {
      auto one = staircase_of(participant, condition, fitter_of(condition.staircase));
      if (stop && stop()) return out;
      if (one) out.staircases.push_back(std::move(*one));
    }
  }
  std::vector<std::vector<double>> groups;
  bool all = true;
  for (const ComparisonCondition& condition : design.conditions) {
    out.conditions.push_back(condition_of(condition, design, out.staircases, fitter_of(condition.staircase)));
    if (stop && stop()) return out;
    groups.push_back(out.conditions.back().thresholds);
    all = all && groups.back().size() == participants.size();
  }
  out.between = one_way_anova(groups);
  if (all) out.repeated = repeated_measures_anova(groups);
  if (out.between) out.pairs = tukey_test(groups, *out.between);
  std::vector<std::string> names;
  for (const ConditionResult& condition : out.conditions) names.push_back(condition.condition);
  out.order = agreement_with_paper(names, all_thresholds(names, participants, out.staircases));
  return out;
}

}  // namespace tangent::analysis
