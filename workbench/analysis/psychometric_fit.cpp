#include "workbench/analysis/psychometric_fit.h"

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tangent::analysis {
namespace {

using experiment::kGuess;
using experiment::Psychometric;
using experiment::Staircase;

constexpr std::size_t kMiddles = 80;
constexpr double kBelow = 1.5, kAbove = 3.0;  // of ln(segments): middles that are tried beyond the levels shown
// Prior of the spread: its power, by ln(spread). With it the tails of narrow and wide functions differ least.
constexpr double kSpreadPower = 0.5;
constexpr double kShare = 0.95, kTail = 0.5 * (1.0 - kShare);
constexpr std::uint64_t kCalibrationSeed = 11, kPoolSeed = 12, kGroupSeed = 13, kRuleSeed = 14;
constexpr double kCalibratedFrom = 0.1, kCalibratedTo = 1.0;  // spreads

// How far an interval's end lies from the median, in deviations of a normal law, is c + m m_1 + m^2 m_2 + ...: m is the
// mean of ln(spread) by the answers; what it is multiplied with hangs on how many octaves of segments the median lies
// above the start, and on how coarse segments are there: of 4, one more is a quarter. These were chosen on 660,000
// staircases of the three rules of the paper's conditions, with thresholds from half the start to sixteen times it, so
// that either end misses as often for narrow functions as for wide ones, near the start and far from it; c is
// calibrated for each rule.
struct EndShape {
  std::array<double, 4> linear;     ///< at kLinearAt octaves
  std::array<double, 2> square;     ///< at 0 and 1.5 octaves
  std::array<double, 2> half_way;   ///< half an octave above the start and below it: c is calibrated at whole ones
  std::array<double, 3> by_coarse;  ///< times m, m^2, m^3 and 10 / segments

  double at(double m, double octaves, double segments) const {
    constexpr std::array<double, 4> kLinearAt{-1.0, 0.0, 1.0, 2.5};
    m = std::clamp(m, -2.2, 0.3);
    double slope = linear.front();
    for (std::size_t i = 1; i < linear.size(); ++i)
      slope += (linear[i] - linear[i - 1]) *
               std::clamp((octaves - kLinearAt[i - 1]) / (kLinearAt[i] - kLinearAt[i - 1]), 0.0, 1.0);
    const double bend = square[0] + (square[1] - square[0]) * std::clamp(octaves / 1.5, 0.0, 1.0);
    const double beside = half_way[0] * std::max(1.0 - std::abs(2.0 * octaves - 1.0), 0.0) +
                          half_way[1] * std::max(1.0 - std::abs(2.0 * octaves + 1.0), 0.0);
    const double coarse = 10.0 / std::max(segments, 3.0);
    return beside + m * (slope + bend * m + coarse * (by_coarse[0] + m * (by_coarse[1] + m * by_coarse[2])));
  }
};
constexpr EndShape kLowShape{{2.82, 5.27, 3.01, 2.85}, {0.66, 1.00}, {0.77, 1.00}, {0.61, -0.55, -0.43}};
constexpr EndShape kHighShape{{1.57, 3.71, 5.01, 4.58}, {-0.58, 0.91}, {-0.07, -0.08}, {3.41, 5.48, 2.08}};
constexpr double kLeastDeviations = 0.3;  // from the median to an end

constexpr std::size_t kPoolSpreads = 12;  // that groups are simulated with, from the narrowest to the widest
constexpr int kGroups = 400;              // for each of them

/// A number for each middle.
using Middles = std::array<double, kMiddles>;

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
};

/// ln(threshold / middle) over the spread: where a function with this rate of lapses is at the balance point.
double logit_at(double balance, double lapse) {
  const double felt = (balance - kGuess) / (1.0 - kGuess - lapse);
  return std::log((1.0 - felt) / felt);
}

/// ln of how likely the answers are, for all middles of one spread; `felt`: by level, middle after middle. Products,
/// with a logarithm only before they get too small: so loops go over middles side by side.
void add_log_likelihoods(std::span<const Level> levels, std::span<const double> felt, double lapse, Middles& out) {
  constexpr double kLeast = 1e-6;  // of a probability: one answer can't be impossible
  constexpr int kMost = 48;        // factors: not below 1e-288
  Middles product;
  product.fill(1.0);
  int factors = 0;
  const auto multiply = [&](const Middles& by, int times) {
    for (; times > 0; --times) {
      for (std::size_t m = 0; m < kMiddles; ++m) product[m] *= by[m];
      if (++factors < kMost) continue;
      for (std::size_t m = 0; m < kMiddles; ++m) out[m] += std::log(product[m]);
      product.fill(1.0);
      factors = 0;
    }
  };
  Middles right, wrong;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::span at = felt.subspan(i * kMiddles, kMiddles);
    for (std::size_t m = 0; m < kMiddles; ++m) {
      right[m] = std::min(kGuess + (1.0 - kGuess - lapse) * at[m], 1.0 - kLeast);
      wrong[m] = 1.0 - right[m];
    }
    multiply(right, levels[i].right);
    multiply(wrong, levels[i].wrong);
  }
  for (std::size_t m = 0; m < kMiddles; ++m) out[m] += std::log(product[m]);
}

class Grid {
 public:
  Grid(std::span<const Level> levels)
      : first_(levels.front().log_segments - kBelow),
        step_((levels.back().log_segments + kAbove - first_) / static_cast<double>(kMiddles - 1)),
        logs_(kMiddles * kSpreads * kLapses.size()) {
    std::vector<double> felt(levels.size() * kMiddles);
    auto out = logs_.begin();
    for (std::size_t s = 0; s < kSpreads; ++s) {
      Middles up;  // exp of each middle, over the spread: a level's part is a factor
      for (std::size_t m = 0; m < kMiddles; ++m) up[m] = std::exp((first_ - middle(m)) / spread_at(s));
      for (std::size_t i = 0; i < levels.size(); ++i) {
        const double level = std::exp((levels[i].log_segments - first_) / spread_at(s));
        for (std::size_t m = 0; m < kMiddles; ++m) felt[i * kMiddles + m] = 1.0 / (1.0 + level * up[m]);
      }
      for (const double lapse : kLapses) {
        Middles logs{};
        add_log_likelihoods(levels, felt, lapse, logs);
        best_ = std::max(best_, *std::max_element(logs.begin(), logs.end()));
        out = std::copy(logs.begin(), logs.end(), out);
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
      for (const double lapse : kLapses) {
        const double beside = spread * logit_at(balance, lapse);
        for (std::size_t m = 0; m < kMiddles; ++m) {
          const double likely = std::exp(*log++ - best_);
          of_spread += likely;
          const double at = (middle(m) + beside - threshold.first) / step_;
          const auto place = static_cast<std::size_t>(at);
          const double beyond = at - static_cast<double>(place);
          threshold.share[place] += prior * likely * (1.0 - beyond);
          threshold.share[place + 1] += prior * likely * beyond;
        }
      }
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
  std::vector<double> logs_;  ///< by spread, lapse, middle
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

double normal_below(double deviations) { return 0.5 * std::erfc(-deviations / std::numbers::sqrt2); }
double normal_deviations(double below) {
  return boost::math::quantile(boost::math::normal(), std::clamp(below, 1e-13, 1.0 - 1e-13));
}

/// A share of sorted values lies below it.
double quantile_of(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(at), sorted.size() - 2);
  return sorted[before] + (at - static_cast<double>(before)) * (sorted[before + 1] - sorted[before]);
}

double pool_log_spread(std::size_t i) {
  return std::log(kNarrowestSpread) +
         std::log(kWidestSpread / kNarrowestSpread) * static_cast<double>(i) / static_cast<double>(kPoolSpreads - 1);
}

/// Where `heights`, over the pools' spreads, reach `height`: ln(spread), within the pools'.
double crossing(std::array<double, kPoolSpreads> heights, double height) {
  for (std::size_t i = 1; i < kPoolSpreads; ++i) heights[i] = std::max(heights[i], heights[i - 1]);
  if (height <= heights.front()) return pool_log_spread(0);
  for (std::size_t i = 1; i < kPoolSpreads; ++i) {
    if (height > heights[i]) continue;
    const double share = (height - heights[i - 1]) / (heights[i] - heights[i - 1]);
    return pool_log_spread(i - 1) + share * (pool_log_spread(i) - pool_log_spread(i - 1));
  }
  return pool_log_spread(kPoolSpreads - 1);
}

}  // namespace

double spread_at(std::size_t i) {
  return kNarrowestSpread *
         std::pow(kWidestSpread / kNarrowestSpread, static_cast<double>(i) / static_cast<double>(kSpreads - 1));
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

namespace {

/// A staircase by a function of this threshold and spread, with a rate of lapses drawn of those that are tried.
std::vector<ComparisonAnswer> drawn_answers(Staircase& staircase, double threshold, double spread, double balance,
                                            SplitMix& random) {
  Psychometric function{1.0, spread, kLapses[random.below(kLapses.size())]};
  function.middle = threshold / function.segments_at(balance);
  return simulated_answers(staircase, function, random);
}

}  // namespace

ThresholdFitter::Calibration ThresholdFitter::calibrate(double threshold) const {
  const double balance = experiment::balance_point(rule_), truth = std::log(threshold);
  std::vector<double> spreads, off, low, high;
  for (int i = 0; i < simulated_; ++i) {
    if (stop_ && stop_()) return {};
    SplitMix random(kCalibrationSeed, static_cast<std::uint64_t>(i));
    const double spread = kCalibratedFrom * std::pow(kCalibratedTo / kCalibratedFrom, random.unit());
    Staircase staircase(rule_);
    const Posterior posterior =
        Grid(levels_of(drawn_answers(staircase, threshold, spread, balance, random))).posterior(balance);
    const double m = posterior.mean_log_spread, median = posterior.threshold.quantile(0.5);
    spreads.push_back(m);
    off.push_back(median - truth);
    const double beyond = normal_deviations(posterior.threshold.below(truth)), octaves = octaves_up(median);
    low.push_back(-beyond - kLowShape.at(m, octaves, std::exp(median)));
    high.push_back(beyond - kHighShape.at(m, octaves, std::exp(median)));
  }
  std::sort(low.begin(), low.end());
  std::sort(high.begin(), high.end());
  return {quantile_of(low, 1.0 - kTail), quantile_of(high, 1.0 - kTail), line_through(spreads, off)};
}

double ThresholdFitter::octaves_up(double log_segments) const {
  const double lowest = std::log2(rule_.fewest / rule_.start), highest = std::log2(rule_.most / rule_.start);
  return std::clamp(log_segments / std::numbers::ln2 - std::log2(rule_.start), lowest, highest);
}

double ThresholdFitter::threshold_at(int place) const {
  return std::clamp(rule_.start * std::exp2(place), rule_.fewest, rule_.most);
}

const ThresholdFitter::Calibration& ThresholdFitter::calibrated(int place) {
  const auto known = known_.find(place);
  if (known != known_.end()) return known->second;
  return known_.emplace(place, calibrate(threshold_at(place))).first->second;
}

FittedThreshold ThresholdFitter::fit(std::span<const ComparisonAnswer> answers) {
  const Posterior posterior = Grid(levels_of(answers)).posterior(experiment::balance_point(rule_));
  const double median = posterior.threshold.quantile(0.5), m = posterior.mean_log_spread;
  // Between the two calibrations beside it, so that none makes a step.
  const double at = octaves_up(median);
  const int place = static_cast<int>(std::floor(at));
  const Calibration &before = calibrated(place), &after = calibrated(place + 1);
  const double share = at - place;
  const auto between = [&](double a, double b) { return a + share * (b - a); };
  const double off = between(before.off[0] + before.off[1] * m, after.off[0] + after.off[1] * m);
  const double low = std::max(between(before.low, after.low) + kLowShape.at(m, at, std::exp(median)), kLeastDeviations);
  const double high =
      std::max(between(before.high, after.high) + kHighShape.at(m, at, std::exp(median)), kLeastDeviations);
  FittedThreshold out;
  out.low = std::exp(posterior.threshold.quantile(normal_below(-low)));
  out.high = std::exp(posterior.threshold.quantile(normal_below(high)));
  out.segments = std::clamp(std::exp(median - off), out.low, out.high);
  out.mean_log_spread = m;
  return out;
}

double ThresholdFitter::rule_bias(double segments, double spread) const {
  const double balance = experiment::balance_point(rule_);
  double sum = 0.0, settled = 0.0;
  for (int i = 0; i < simulated_; ++i) {
    if (stop_ && stop_()) break;
    SplitMix random(kRuleSeed, static_cast<std::uint64_t>(i));
    Staircase staircase(rule_);
    drawn_answers(staircase, segments, spread, balance, random);
    if (!staircase.settled()) continue;
    settled += 1.0;
    sum += std::log(staircase.threshold() / segments);
  }
  return settled > 0.0 ? std::exp(sum / settled) : std::nan("");
}

std::vector<double> ThresholdFitter::pool_of(int place, std::size_t spread) const {
  const double balance = experiment::balance_point(rule_);
  std::vector<double> out;
  for (int i = 0; i < std::clamp(simulated_ / 5, 20, 200); ++i) {
    if (stop_ && stop_()) break;
    SplitMix random(kPoolSeed, static_cast<std::uint64_t>(i));
    Staircase staircase(rule_);
    const auto answers =
        drawn_answers(staircase, threshold_at(place), std::exp(pool_log_spread(spread)), balance, random);
    out.push_back(Grid(levels_of(answers)).posterior(balance).mean_log_spread);
  }
  return out;
}

const ThresholdFitter::Pools& ThresholdFitter::pools(int place) {
  const auto known = pools_.find(place);
  if (known != pools_.end()) return known->second;
  Pools& made = pools_[place];
  for (std::size_t s = 0; s < kPoolSpreads; ++s) made.push_back(pool_of(place, s));
  return made;
}

SpreadInterval ThresholdFitter::common_spread(std::span<const FittedThreshold> staircases) {
  double found = 0.0;
  std::vector<const Pools*> alike;
  for (const FittedThreshold& one : staircases) {
    found += one.mean_log_spread / static_cast<double>(staircases.size());
    alike.push_back(&pools(static_cast<int>(std::lround(octaves_up(std::log(one.segments))))));
  }
  if (stop_ && stop_()) return {};
  std::array<double, kPoolSpreads> low{}, middle{}, high{};
  for (std::size_t s = 0; s < kPoolSpreads; ++s) {
    std::vector<double> groups;
    for (int g = 0; g < kGroups; ++g) {
      SplitMix random(kGroupSeed, static_cast<std::uint64_t>(g));
      double sum = 0.0;
      for (const Pools* pool : alike) sum += (*pool)[s][random.below((*pool)[s].size())];
      groups.push_back(sum / static_cast<double>(alike.size()));
    }
    std::sort(groups.begin(), groups.end());
    low[s] = quantile_of(groups, kTail);
    middle[s] = quantile_of(groups, 0.5);
    high[s] = quantile_of(groups, 1.0 - kTail);
  }
  return {std::exp(crossing(middle, found)), std::exp(crossing(high, found)), std::exp(crossing(low, found))};
}

}  // namespace tangent::analysis
