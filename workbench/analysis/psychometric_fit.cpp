#include "workbench/analysis/psychometric_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent::analysis {
namespace {

using experiment::kGuess;
using experiment::Psychometric;
using experiment::Staircase;

constexpr std::size_t kMiddles = 80;
constexpr double kBelow = 1.5, kAbove = 3.0;  // of ln(segments): middles that are tried beyond the levels shown
// Prior of the spread: its power, by ln(spread). With it the tails of narrow and wide functions differ least.
constexpr double kSpreadPower = 0.5;
constexpr double kTailSlope = 1.3;
constexpr double kShare = 0.95;
// Of the common spread: all middles alike, wide functions are taken for wider, up to twice; with this power of the
// spread for each staircase narrow ones for narrower. The truth is between.
constexpr double kNarrowing = -0.25;
constexpr std::uint64_t kCalibrationSeed = 11;
constexpr double kCalibratedFrom = 0.1, kCalibratedTo = 1.0;  // spreads

/// Answers at one level.
struct Level {
  double log_segments = 0.0;
  int right = 0, wrong = 0;
};

std::vector<Level> levels_of(std::span<const ComparisonAnswer> answers) {
  std::vector<ComparisonAnswer> sorted(answers.begin(), answers.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.segments < b.segments; });
  std::vector<Level> out;
  double last = 0.0;
  for (const ComparisonAnswer& answer : sorted) {
    if (out.empty() || answer.segments != last) out.push_back({std::log(answer.segments), 0, 0});
    last = answer.segments;
    ++(answer.right ? out.back().right : out.back().wrong);
  }
  return out;
}

/// A share of probability for each of evenly spaced places; each is spread over its step.
struct Shares {
  double first = 0.0, step = 1.0;
  std::vector<double> share;

  void scale() {
    double sum = 0.0;
    for (const double s : share) sum += s;
    for (double& s : share) s /= sum;
  }
  /// Probability of a place below `x`.
  double below(double x) const {
    const double at = (x - first) / step + 0.5;
    double sum = 0.0;
    for (std::size_t i = 0; i < share.size(); ++i) sum += share[i] * std::clamp(at - static_cast<double>(i), 0.0, 1.0);
    return sum;
  }
  double quantile(double probability) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < share.size(); ++i) {
      if (sum + share[i] >= probability && share[i] > 0.0)
        return first + step * (static_cast<double>(i) - 0.5 + (probability - sum) / share[i]);
      sum += share[i];
    }
    return first + step * (static_cast<double>(share.size()) - 0.5);
  }
};

/// What the answers say of all functions of the grid.
struct Posterior {
  Shares threshold;  ///< logarithms of segments at the balance point
  double mean_log_spread = 0.0;
  SpreadLikelihood spreads{};
};

/// ln(threshold / middle) over the spread: where a function with this rate of lapses is at the balance point.
double logit_at(double balance, double lapse) {
  const double felt = (balance - kGuess) / (1.0 - kGuess - lapse);
  return std::log((1.0 - felt) / felt);
}

/// ln of how likely the answers are; `felt`: by level. Products, with a logarithm only before they get too small: a
/// hundred times as many multiplications as logarithms.
double log_likelihood(std::span<const Level> levels, std::span<const double> felt, double lapse) {
  constexpr double kLeast = 1e-6;  // of a probability: one answer can't be impossible
  constexpr double kSmall = 1e-200;
  double product = 1.0, log = 0.0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double p = std::min(kGuess + (1.0 - kGuess - lapse) * felt[i], 1.0 - kLeast);
    for (int n = 0; n < levels[i].right + levels[i].wrong; ++n) {
      product *= n < levels[i].right ? p : 1.0 - p;
      if (product > kSmall) continue;
      log += std::log(product);
      product = 1.0;
    }
  }
  return log + std::log(product);
}

class Grid {
 public:
  Grid(std::span<const Level> levels)
      : first_(levels.front().log_segments - kBelow),
        step_((levels.back().log_segments + kAbove - first_) / static_cast<double>(kMiddles - 1)),
        logs_(kMiddles * kSpreads * kLapses.size()) {
    std::vector<double> felt(levels.size());
    auto out = logs_.begin();
    for (std::size_t s = 0; s < kSpreads; ++s) {
      for (std::size_t m = 0; m < kMiddles; ++m) {
        for (std::size_t i = 0; i < levels.size(); ++i)
          felt[i] = 1.0 / (1.0 + std::exp((levels[i].log_segments - middle(m)) / spread_at(s)));
        for (const double lapse : kLapses) best_ = std::max(best_, *out++ = log_likelihood(levels, felt, lapse));
      }
    }
  }

  Posterior posterior(double balance) const {
    Posterior out;
    Shares& threshold = out.threshold;
    double reach = 2.0 * step_;  // of thresholds beyond the middles
    for (const double lapse : kLapses) reach = std::max(reach, kWidestSpread * std::abs(logit_at(balance, lapse)));
    const auto before = static_cast<std::size_t>(reach / step_) + 2;
    threshold.step = step_;
    threshold.first = first_ - step_ * static_cast<double>(before);
    threshold.share.assign(kMiddles + 2 * before, 0.0);
    double sum = 0.0;
    auto log = logs_.begin();
    for (std::size_t s = 0; s < kSpreads; ++s) {
      const double spread = spread_at(s), prior = std::pow(spread, kSpreadPower);
      double of_spread = 0.0;
      for (std::size_t m = 0; m < kMiddles; ++m) {
        for (const double lapse : kLapses) {
          const double likely = std::exp(*log++ - best_);
          of_spread += likely;
          const double at = (middle(m) + spread * logit_at(balance, lapse) - threshold.first) / step_;
          const auto place = static_cast<std::size_t>(at);
          const double beyond = at - static_cast<double>(place);
          threshold.share[place] += prior * likely * (1.0 - beyond);
          threshold.share[place + 1] += prior * likely * beyond;
        }
      }
      out.spreads[s] = std::log(std::max(of_spread, 1e-300)) + best_;
      out.mean_log_spread += prior * of_spread * std::log(spread);
      sum += prior * of_spread;
    }
    out.mean_log_spread /= sum;
    threshold.scale();
    return out;
  }

 private:
  double middle(std::size_t m) const { return first_ + step_ * static_cast<double>(m); }
  double first_, step_;
  std::vector<double> logs_;  ///< by spread, middle, lapse
  double best_ = -std::numeric_limits<double>::infinity();
};

/// The line through values y at x with the least squares: its height at 0 and its slope.
std::array<double, 2> line_through(std::span<const double> x, std::span<const double> y) {
  if (x.empty()) return {0.0, 0.0};
  const auto n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  const double slope = xx > 0.0 ? xy / xx : 0.0;
  return {my - slope * mx, slope};
}

/// By ln(spread), where each staircase counts by a power of the spread besides.
Shares shares_of_spreads(std::span<const SpreadLikelihood> staircases, double power) {
  SpreadLikelihood logs{};
  for (const SpreadLikelihood& one : staircases)
    for (std::size_t s = 0; s < kSpreads; ++s) logs[s] += one[s] + power * std::log(spread_at(s));
  // Many staircases leave a peak narrower than the grid: between its places the logarithm is a parabola.
  constexpr std::size_t kFine = 20;
  Shares out{std::log(kNarrowestSpread), std::log(spread_at(1) / spread_at(0)) / kFine, {}};
  const double best = *std::max_element(logs.begin(), logs.end());
  for (std::size_t i = 0; i <= (kSpreads - 1) * kFine; ++i) {
    const std::size_t near = std::clamp<std::size_t>((i + kFine / 2) / kFine, 1, kSpreads - 2);
    const double off = static_cast<double>(i) / kFine - static_cast<double>(near);
    const double slope = 0.5 * (logs[near + 1] - logs[near - 1]);
    const double bend = logs[near + 1] - 2.0 * logs[near] + logs[near - 1];
    out.share.push_back(std::exp(logs[near] + off * (slope + 0.5 * off * bend) - best));
  }
  out.scale();
  return out;
}

}  // namespace

double spread_at(std::size_t i) {
  return kNarrowestSpread *
         std::pow(kWidestSpread / kNarrowestSpread, static_cast<double>(i) / static_cast<double>(kSpreads - 1));
}

SpreadInterval common_spread(std::span<const SpreadLikelihood> staircases) {
  const Shares wide = shares_of_spreads(staircases, 0.0), narrow = shares_of_spreads(staircases, kNarrowing);
  const double tail = 0.5 * (1.0 - kShare);
  return {std::exp(0.5 * (wide.quantile(0.5) + narrow.quantile(0.5))), std::exp(narrow.quantile(tail)),
          std::exp(wide.quantile(1.0 - tail))};
}

std::vector<ComparisonAnswer> simulated_answers(Staircase& staircase, const Psychometric& function, SplitMix& random) {
  std::vector<ComparisonAnswer> out;
  while (!staircase.done()) {
    const double segments = staircase.segments();
    out.push_back({segments, random.unit() < function.right(segments)});
    staircase.answer(out.back().right);
  }
  return out;
}

ThresholdFitter::Calibration ThresholdFitter::calibrate(double threshold) const {
  const double balance = experiment::balance_point(rule_), truth = std::log(threshold);
  std::vector<double> spreads, off, settled, rule, tails;
  for (int i = 0; i < simulated_; ++i) {
    if (stop_ && stop_()) return {};
    SplitMix random(kCalibrationSeed, static_cast<std::uint64_t>(i));
    Psychometric function{1.0, kCalibratedFrom * std::pow(kCalibratedTo / kCalibratedFrom, random.unit()), 0.0};
    function.lapse = kLapses[random.below(kLapses.size())];
    function.middle = threshold / function.segments_at(balance);
    Staircase staircase(rule_);
    const Posterior posterior = Grid(levels_of(simulated_answers(staircase, function, random))).posterior(balance);
    const double m = posterior.mean_log_spread, below = posterior.threshold.below(truth);
    spreads.push_back(m);
    off.push_back(posterior.threshold.quantile(0.5) - truth);
    const double tail = std::clamp(2.0 * std::min(below, 1.0 - below), 1e-12, 1.0 - 1e-9);
    tails.push_back(std::log(-std::log(tail)) - kTailSlope * m);
    if (!staircase.settled()) continue;
    settled.push_back(m);
    rule.push_back(std::log(staircase.threshold()) - truth);
  }
  const auto place = tails.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(tails.size()));
  std::nth_element(tails.begin(), place, tails.end());
  return {*place, line_through(spreads, off), line_through(settled, rule)};
}

const ThresholdFitter::Calibration& ThresholdFitter::calibrated(int place) {
  const auto known = known_.find(place);
  if (known != known_.end()) return known->second;
  const double threshold = std::clamp(rule_.start * std::exp2(place), rule_.fewest, rule_.most);
  return known_.emplace(place, calibrate(threshold)).first->second;
}

FittedThreshold ThresholdFitter::fit(std::span<const ComparisonAnswer> answers) {
  const Posterior posterior = Grid(levels_of(answers)).posterior(experiment::balance_point(rule_));
  const double median = posterior.threshold.quantile(0.5), m = posterior.mean_log_spread;
  // Between the two calibrations beside it, so that none makes a step.
  const double lowest = std::log2(rule_.fewest / rule_.start), highest = std::log2(rule_.most / rule_.start);
  const double at = std::clamp(median / std::log(2.0) - std::log2(rule_.start), lowest, highest);
  const int place = static_cast<int>(std::floor(at));
  const Calibration &before = calibrated(place), &after = calibrated(place + 1);
  const double share = at - place;
  const auto between = [&](double a, double b) { return a + share * (b - a); };
  const auto line = [&](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return between(a[0] + a[1] * m, b[0] + b[1] * m);
  };
  const double tail = std::exp(-std::exp(between(before.tail, after.tail) + kTailSlope * m));
  FittedThreshold out;
  out.low = std::exp(posterior.threshold.quantile(0.5 * tail));
  out.high = std::exp(posterior.threshold.quantile(1.0 - 0.5 * tail));
  out.segments = std::clamp(std::exp(median - line(before.off, after.off)), out.low, out.high);
  out.rule_bias = std::exp(line(before.rule, after.rule));
  out.spreads = posterior.spreads;
  return out;
}

}  // namespace tangent::analysis
