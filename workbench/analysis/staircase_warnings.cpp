#include "workbench/analysis/staircase_warnings.h"

#include "workbench/analysis/comparison_results.h"
#include "workbench/analysis/page_table.h"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cmath>

namespace tangent::analysis {
namespace {

constexpr double kGuessingAt = 0.05;

/// Whether at least half of the averaged reversals were at this level.
bool mostly_at(const StaircaseResult& staircase, const experiment::StaircaseRule& rule, int level) {
  const auto averaged = static_cast<std::ptrdiff_t>(
      std::min<std::size_t>(staircase.reversals.size(), static_cast<std::size_t>(rule.averaged)));
  const auto there = std::count_if(staircase.reversals.end() - averaged, staircase.reversals.end(), [&](int trial) {
    return staircase.levels[static_cast<std::size_t>(trial)] == level;
  });
  return averaged > 0 && 2 * there >= averaged;
}

}  // namespace

double guessing_probability(int right, int count) {
  if (right <= 0) return 1.0;
  const boost::math::binomial guesses(count, experiment::kGuess);
  return boost::math::cdf(boost::math::complement(guesses, right - 1));
}

std::vector<std::string> staircase_warnings(const StaircaseResult& staircase, const experiment::StaircaseRule& rule) {
  std::vector<std::string> out;
  const int fewest = static_cast<int>(std::lround(rule.fewest)), most = static_cast<int>(std::lround(rule.most));
  if (!staircase.segments) out.emplace_back("did not settle");
  if (mostly_at(staircase, rule, fewest))
    out.push_back("lies at the fewest segments that are shown, " + std::to_string(fewest) +
                  ": the threshold is there or below");
  if (mostly_at(staircase, rule, most))
    out.push_back("lies at the most segments that are shown, " + std::to_string(most) +
                  ": the threshold is there or above");
  if (staircase.fitted.segments < rule.fewest || staircase.fitted.segments > rule.most)
    out.emplace_back("the fit lies beyond what can be shown");
  const auto right = static_cast<int>(std::count(staircase.right.begin(), staircase.right.end(), 1));
  const double p = guessing_probability(right, staircase.trials);
  if (p > kGuessingAt)
    out.push_back("no better than guessing (" + std::to_string(right) + " of " + std::to_string(staircase.trials) +
                  " right, p " + probability_text(p) + ")");
  return out;
}

}  // namespace tangent::analysis
