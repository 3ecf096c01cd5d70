#include "workbench/analysis/psychometric_fit.h"

#include "core/base/split_mix.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tangent::analysis {
namespace {

using experiment::kGuess;
using experiment::Psychometric;
using experiment::Staircase;
using experiment::StaircaseRule;

/// Answers at one level.
struct Level {
  double log_segments = 0.0, count = 0.0, right = 0.0;
};

std::vector<Level> levels_of(std::span<const ComparisonAnswer> answers) {
  std::vector<ComparisonAnswer> sorted(answers.begin(), answers.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.segments < b.segments; });
  std::vector<Level> out;
  double last = 0.0;
  for (const ComparisonAnswer& answer : sorted) {
    if (out.empty() || answer.segments != last) out.push_back({std::log(answer.segments), 0.0, 0.0});
    last = answer.segments;
    out.back().count += 1.0;
    out.back().right += answer.right ? 1.0 : 0.0;
  }
  return out;
}

/// The logarithm of how likely the answers are, its slope and Fisher's information, by ln(middle) and ln(spread).
struct Likelihood {
  double log = 0.0;
  double slope[2] = {0.0, 0.0};
  double information[3] = {0.0, 0.0, 0.0};  ///< middle-middle, middle-spread, spread-spread
};

Likelihood likelihood(std::span<const Level> levels, double middle, double spread, double lapse) {
  constexpr double kLeast = 1e-9;  // of a probability: one answer can't be impossible
  Likelihood out;
  const double s = std::exp(spread), range = 1.0 - kGuess - lapse;
  for (const Level& level : levels) {
    const double z = (level.log_segments - middle) / s;
    const double felt = 1.0 / (1.0 + std::exp(z));
    const double p = std::clamp(kGuess + range * felt, kLeast, 1.0 - kLeast);
    out.log += level.right * std::log(p) + (level.count - level.right) * std::log(1.0 - p);
    const double by_z = -range * felt * (1.0 - felt);
    const double by_middle = -by_z / s, by_spread = -by_z * z;
    const double weight = (level.right - level.count * p) / (p * (1.0 - p));
    const double information = level.count / (p * (1.0 - p));
    out.slope[0] += weight * by_middle;
    out.slope[1] += weight * by_spread;
    out.information[0] += information * by_middle * by_middle;
    out.information[1] += information * by_middle * by_spread;
    out.information[2] += information * by_spread * by_spread;
  }
  const double off = (spread - std::log(kSpreadPrior)) / kSpreadPriorWidth;
  out.log -= 0.5 * off * off;
  out.slope[1] -= off / kSpreadPriorWidth;
  out.information[2] += 1.0 / (kSpreadPriorWidth * kSpreadPriorWidth);
  return out;
}

struct Fit {
  double middle = 0.0, spread = 0.0;  ///< logarithms
  double log = -std::numeric_limits<double>::infinity();
};

/// Fisher's scoring with steps halved until they gain. The middle stays within a factor of 100 of the levels shown:
/// with right answers alone it would leave for infinity.
Fit climb(std::span<const Level> levels, double lapse, double middle) {
  const double lowest = levels.front().log_segments - std::log(100.0);
  const double highest = levels.back().log_segments + std::log(100.0);
  Fit at{middle, std::log(kSpreadPrior), 0.0};
  Likelihood here = likelihood(levels, at.middle, at.spread, lapse);
  for (int i = 0; i < 60; ++i) {
    const double a = here.information[0] + 1e-6, b = here.information[1], c = here.information[2];
    const double determinant = a * c - b * b;
    const double step_middle = (c * here.slope[0] - b * here.slope[1]) / determinant;
    const double step_spread = (a * here.slope[1] - b * here.slope[0]) / determinant;
    double share = std::min(1.0, 2.0 / (std::abs(step_middle) + std::abs(step_spread) + 1e-300));
    bool gained = false;
    for (int halvings = 0; halvings < 30 && !gained; ++halvings, share *= 0.5) {
      const double m = std::clamp(at.middle + share * step_middle, lowest, highest);
      const double s = at.spread + share * step_spread;
      const Likelihood there = likelihood(levels, m, s, lapse);
      if (!(there.log > here.log)) continue;
      gained = there.log > here.log + 1e-10;
      at = {m, s, 0.0};
      here = there;
      break;
    }
    if (!gained) break;
  }
  at.log = here.log;
  return at;
}

Psychometric curve(const Fit& fit, double lapse) { return {std::exp(fit.middle), std::exp(fit.spread), lapse}; }

double mean_level(std::span<const Level> levels) {
  double sum = 0.0, count = 0.0;
  for (const Level& level : levels) {
    sum += level.count * level.log_segments;
    count += level.count;
  }
  return sum / count;
}

/// A staircase of a participant with this function.
Staircase run_staircase(const StaircaseRule& rule, const Psychometric& function, SplitMix& random,
                        std::vector<ComparisonAnswer>& answers) {
  Staircase staircase(rule);
  answers.clear();
  while (!staircase.done()) {
    const double segments = staircase.segments();
    const bool right = random.unit() < function.right(segments);
    answers.push_back({segments, right});
    staircase.answer(right);
  }
  return staircase;
}

/// How likely the answers can be where the threshold, in ln(segments), is given: the best spread and rate of lapses.
double profile(std::span<const Level> levels, double threshold, double balance) {
  constexpr double kNarrow = -4.6, kWide = 1.4;  // of ln(spread): 0.01 to 4
  constexpr int kSteps = 12;
  double best = -std::numeric_limits<double>::infinity();
  for (const double lapse : kLapses) {
    const double felt = (balance - kGuess) / (1.0 - kGuess - lapse), logit = std::log((1.0 - felt) / felt);
    const auto at = [&](double spread) {
      return likelihood(levels, threshold - std::exp(spread) * logit, spread, lapse).log;
    };
    int place = 0;
    double top = -std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i) {
      const double here = at(kNarrow + (kWide - kNarrow) * i / kSteps);
      if (here <= top) continue;
      top = here;
      place = i;
    }
    const double width = (kWide - kNarrow) / kSteps, middle = kNarrow + width * place;
    const auto found =
        boost::math::tools::brent_find_minima([&](double x) { return -at(x); }, middle - width, middle + width, 12);
    best = std::max({best, top, -found.second});
  }
  return best;
}

/// Of a fit whose likelihood is `best`: twice what is lost where the threshold is `threshold`.
double lost(std::span<const Level> levels, double best, double threshold, double balance) {
  return 2.0 * std::max(0.0, best - profile(levels, threshold, balance));
}

/// Where the loss passes `most`, from the fitted threshold outwards; at most a factor of 100 away. Logarithms.
double end_of_interval(std::span<const Level> levels, double best, double threshold, double balance, double most,
                       double direction) {
  double inside = threshold, outside = threshold, step = 0.05;
  do {
    inside = outside;
    outside += direction * step;
    step *= 1.7;
  } while (lost(levels, best, outside, balance) < most && std::abs(outside - threshold) < std::log(100.0));
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (inside + outside);
    (lost(levels, best, middle, balance) < most ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

struct LikelyFit {
  Psychometric curve;
  double log = -std::numeric_limits<double>::infinity();
};
LikelyFit likeliest(std::span<const Level> levels) {
  LikelyFit out;
  for (const double lapse : kLapses) {
    const Fit fit = climb(levels, lapse, mean_level(levels));
    if (fit.log > out.log) out = {curve(fit, lapse), fit.log};
  }
  return out;
}

/// Which spreads and lapses the answers leave possible, and how likely each is, all thresholds taken together.
class PossibleShapes {
 public:
  explicit PossibleShapes(std::span<const Level> levels) {
    constexpr double kNarrow = -4.6, kWide = 1.4;  // of ln(spread): 0.01 to 4
    constexpr int kSpreads = 24, kMiddles = 60;
    const double lowest = levels.front().log_segments - 2.5, highest = levels.back().log_segments + 2.5;
    double best = -std::numeric_limits<double>::infinity();
    for (const double lapse : kLapses) {
      for (int i = 0; i <= kSpreads; ++i) {
        const double spread = kNarrow + (kWide - kNarrow) * i / kSpreads;
        for (int j = 0; j <= kMiddles; ++j) {
          const double middle = lowest + (highest - lowest) * j / kMiddles;
          shapes_.push_back({std::exp(spread), lapse, likelihood(levels, middle, spread, lapse).log});
          best = std::max(best, shapes_.back().sum);
        }
      }
    }
    double sum = 0.0;
    for (Shape& shape : shapes_) shape.sum = sum += std::exp(shape.sum - best);
  }
  /// One of them, with this threshold (at `balance`).
  Psychometric draw(SplitMix& random, double threshold, double balance) const {
    const double at = random.unit() * shapes_.back().sum;
    const auto shape = std::upper_bound(shapes_.begin(), shapes_.end() - 1, at,
                                        [](double value, const Shape& s) { return value < s.sum; });
    Psychometric out{1.0, shape->spread, shape->lapse};
    out.middle = threshold / out.segments_at(balance);
    return out;
  }

 private:
  struct Shape {
    double spread, lapse, sum;  ///< sum: of the likelihoods up to this one
  };
  std::vector<Shape> shapes_;
};

}  // namespace

Psychometric fit_psychometric(std::span<const ComparisonAnswer> answers) { return likeliest(levels_of(answers)).curve; }

FittedThreshold fit_threshold(std::span<const ComparisonAnswer> answers, const StaircaseRule& rule, std::uint64_t seed,
                              int repeats) {
  FittedThreshold out;
  const std::vector<Level> levels = levels_of(answers);
  const LikelyFit fit = likeliest(levels);
  out.fit = fit.curve;
  const double balance = experiment::balance_point(rule);
  out.segments = out.fit.segments_at(balance);
  const double threshold = std::log(out.segments);
  const PossibleShapes shapes(levels);
  std::vector<double> losses;
  std::vector<ComparisonAnswer> made;
  double bias = 0.0;
  int settled = 0;
  for (int i = 0; i < repeats; ++i) {
    SplitMix random(seed, static_cast<std::uint64_t>(i));
    const Staircase staircase = run_staircase(rule, shapes.draw(random, out.segments, balance), random, made);
    if (staircase.settled()) {
      bias += std::log(staircase.threshold() / out.segments);
      ++settled;
    }
    const std::vector<Level> again = levels_of(made);
    losses.push_back(lost(again, likeliest(again).log, threshold, balance));
  }
  out.rule_bias = settled > 0 ? std::exp(bias / settled) : 1.0;
  const auto place = losses.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(losses.size()));
  std::nth_element(losses.begin(), place, losses.end());
  out.critical = *place;
  out.low = std::exp(end_of_interval(levels, fit.log, threshold, balance, *place, -1.0));
  out.high = std::exp(end_of_interval(levels, fit.log, threshold, balance, *place, 1.0));
  return out;
}

}  // namespace tangent::analysis
