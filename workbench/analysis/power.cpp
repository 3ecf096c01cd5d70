#include "workbench/analysis/power.h"

#include "core/base/split_mix.h"
#include "workbench/analysis/confusion.h"
#include "workbench/analysis/group_tests.h"
#include "workbench/experiment/paper_results.h"
#include "workbench/experiment/psychometric.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent::analysis {
namespace {

namespace math = boost::math;
using experiment::Psychometric;
using experiment::Staircase;

constexpr double kLevel = 0.05;
constexpr std::array kParticipants{4, 6, 8, 12, 16, 24, 32};
constexpr std::array kRatios{1.25, 1.5, 2.0};
constexpr std::array kPoints{3.0, 5.0, 10.0};  // percent
constexpr double kPowerSpread = 0.35, kPowerLapse = 0.02;
constexpr std::uint64_t kPowerSeed = 5;
constexpr int kMostTries = 200;  // of one condition's staircase, until it settles

double normal_of(SplitMix& random) {
  return math::quantile(math::normal(), std::clamp(random.unit(), 1e-12, 1.0 - 1e-12));
}

double variance_of(std::span<const double> values) {
  double mean = 0.0, out = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) out += (v - mean) * (v - mean) / static_cast<double>(values.size() - 1);
  return out;
}

/// One participant's values, one a condition.
using Draw = std::function<Result<std::vector<double>>(SplitMix&)>;

tl::unexpected<Error> never_settles(const experiment::ComparisonCondition& condition) {
  const std::string tries = std::to_string(kMostTries);
  return fail("the staircase doesn't settle within most_trials = " + std::to_string(condition.staircase.most_trials) +
                  " in " + tries + " of " + tries + " tries",
              "[staircase], with the steps of " + condition.name, "allow more trials, or ask for fewer reversals");
}

/// ln(threshold) by the rule, under each condition; the last one's is `ratio` times the others'.
Draw thresholds_of(const experiment::Discrimination& design, double ratio) {
  const experiment::ComparisonCondition first = design.conditions.front();
  const std::size_t conditions = std::max<std::size_t>(design.conditions.size(), 2);
  return [=](SplitMix& random) -> Result<std::vector<double>> {
    const experiment::StaircaseRule& rule = first.staircase;
    const double usual = 4.0 * rule.start;  // starts are a quarter of the thresholds that are expected
    const double shared = kPowerBetween * std::sqrt(kPowerShared) * normal_of(random);
    std::vector<double> out;
    for (int tries = 0; out.size() < conditions; ++tries) {
      if (tries == kMostTries) return never_settles(first);
      const double own = kPowerBetween * std::sqrt(1.0 - kPowerShared) * normal_of(random);
      const double threshold = usual * (out.size() + 1 == conditions ? ratio : 1.0) * std::exp(shared + own);
      Psychometric function{1.0, kPowerSpread, kPowerLapse};
      function.middle = threshold / function.segments_at(experiment::balance_point(rule));
      Staircase staircase(rule);
      while (!staircase.done()) staircase.answer(random.unit() < function.right(staircase.segments()));
      if (!staircase.settled()) continue;
      out.push_back(std::log(staircase.threshold()));
      tries = -1;  // of the next condition: none yet
    }
    return out;
  };
}

/// Shares of right answers under two kinds of trials.
Draw accuracies_of(const experiment::Identification& design, double points) {
  const int runs = design.sessions * design.blocks * design.runs;
  const int trials = runs * static_cast<int>(design.objects.size());  // of one kind: each object shaded and unshaded
  return [=](SplitMix& random) -> Result<std::vector<double>> {
    const double half = 0.005 * points;
    const double drawn = experiment::kPaperAccuracyPercent + experiment::kPaperAccuracyDeviation * normal_of(random);
    const double own = std::clamp(0.01 * drawn, half, 1.0 - half);  // so that the difference is there for everybody
    std::vector<double> out;
    for (const double share : {own - half, own + half}) {
      int right = 0;
      for (int i = 0; i < trials; ++i) right += random.unit() < share;
      out.push_back(static_cast<double>(right) / trials);
    }
    return out;
  };
}

/// Values of all participants, condition by condition.
using Values = std::vector<std::vector<double>>;
using Stop = std::function<bool()>;

Values first_of(const Values& values, int participants) {
  Values out;
  for (const auto& condition : values) out.emplace_back(condition.begin(), condition.begin() + participants);
  return out;
}

/// Empty where it was stopped.
Result<Values> group_of(const Draw& draw, std::size_t participants, std::uint64_t place, const Stop& stop) {
  SplitMix random(kPowerSeed, place);
  Values out;
  for (std::size_t p = 0; p < participants; ++p) {
    if (stop && stop()) return Values{};
    const Result<std::vector<double>> values = draw(random);
    if (!values) return tl::unexpected(values.error());
    out.resize(values->size());
    for (std::size_t c = 0; c < values->size(); ++c) out[c].push_back((*values)[c]);
  }
  return out;
}

bool finds_pair(const Values& values) {
  const auto test = paired_t_test(values.back(), values.front());
  return test && test->p < kLevel;
}
bool finds_any(const Values& values) {
  const auto test = repeated_measures_anova(values);
  return test && test->p < kLevel;
}

struct Test {
  std::string name;
  bool (*finds)(const Values&);
  std::function<double(int)> theory;
};

/// What there is to find, and what finds it.
struct Question {
  double difference = 0.0;
  Draw draw;
  std::vector<Test> tests;
};

/// A row a test and number of participants: the smaller groups are parts of the larger. None where it was stopped.
Status add_rows(const Question& question, int groups, const Stop& stop, PowerTable& out) {
  const std::vector<Test>& tests = question.tests;
  std::vector<std::array<std::uint64_t, kParticipants.size()>> found(tests.size());
  for (int g = 0; g < groups; ++g) {
    const auto values = group_of(question.draw, kParticipants.back(), static_cast<std::uint64_t>(g) + 1, stop);
    if (!values) return tl::unexpected(values.error());
    if (values->empty()) return {};
    for (std::size_t i = 0; i < kParticipants.size(); ++i) {
      const Values part = first_of(*values, kParticipants[i]);
      for (std::size_t t = 0; t < tests.size(); ++t) found[t][i] += tests[t].finds(part);
    }
  }
  for (std::size_t t = 0; t < tests.size(); ++t) {
    for (std::size_t i = 0; i < kParticipants.size(); ++i) {
      const RatioInterval share = share_interval(found[t][i], static_cast<std::uint64_t>(groups));
      out.rows.push_back({tests[t].name, question.difference, kParticipants[i], share.ratio, share.low, share.high,
                          tests[t].theory(kParticipants[i])});
    }
  }
  return {};
}

/// Deviations that the theory asks for, from many participants.
Result<Values> many_of(const Draw& draw, const Stop& stop) { return group_of(draw, 4000, 0, stop); }
double pair_deviation(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences;
  for (std::size_t p = 0; p < a.size(); ++p) differences.push_back(b[p] - a[p]);
  return std::sqrt(variance_of(differences));
}
double pair_deviation(const Values& values) { return pair_deviation(values.front(), values.back()); }
/// What is left when participants are taken out: half of the variance of differences, over all pairs.
double rest_variance(const Values& values) {
  double sum = 0.0, pairs = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t j = i + 1; j < values.size(); ++j) {
      const double deviation = pair_deviation(values[i], values[j]);
      sum += 0.5 * deviation * deviation;
      pairs += 1.0;
    }
  }
  return sum / pairs;
}

Question of_thresholds(double ratio, const Draw& draw, const Values& many) {
  const double effect = std::log(ratio) / pair_deviation(many);
  const int conditions = static_cast<int>(many.size());
  const double squares = std::log(ratio) * std::log(ratio) * (conditions - 1.0) / conditions / rest_variance(many);
  return {ratio,
          draw,
          {{"paired t", finds_pair, [=](int n) { return paired_t_power(effect, n); }},
           {"analysis of variance", finds_any, [=](int n) { return anova_power(squares, conditions, n); }}}};
}
Question of_accuracies(double points, const Draw& draw, const Values& many) {
  const double effect = 0.01 * points / pair_deviation(many);
  return {points, draw, {{"paired t", finds_pair, [=](int n) { return paired_t_power(effect, n); }}}};
}

}  // namespace

double paired_t_power(double effect, int count) {
  const double freedom = count - 1.0;
  const double critical = math::quantile(math::complement(math::students_t(freedom), 0.5 * kLevel));
  const math::non_central_t t(freedom, effect * std::sqrt(static_cast<double>(count)));
  return math::cdf(math::complement(t, critical)) + math::cdf(t, -critical);
}

double anova_power(double squares, int conditions, int count) {
  if (!(squares > 0.0)) return kLevel;  // Boost 1.74 gives kLevel - 1 there
  const double between = conditions - 1.0, error = between * (count - 1.0);
  const double critical = math::quantile(math::complement(math::fisher_f(between, error), kLevel));
  return math::cdf(math::complement(math::non_central_f(between, error, squares * count), critical));
}

Result<PowerTable> power_table(const experiment::Protocol& protocol, int groups, const Stop& stop) {
  const experiment::Discrimination* design = protocol.discrimination();
  PowerTable out;
  out.difference = design != nullptr ? "thresholds, ratio" : "right answers, percentage points";
  for (const double difference : design != nullptr ? kRatios : kPoints) {
    const Draw draw =
        design != nullptr ? thresholds_of(*design, difference) : accuracies_of(*protocol.identification(), difference);
    const Result<Values> many = many_of(draw, stop);
    if (!many) return tl::unexpected(many.error());
    if (many->empty()) break;
    const Question question =
        design != nullptr ? of_thresholds(difference, draw, *many) : of_accuracies(difference, draw, *many);
    if (Status ok = add_rows(question, groups, stop, out); !ok) return tl::unexpected(ok.error());
    if (stop && stop()) break;
  }
  return out;
}

}  // namespace tangent::analysis
