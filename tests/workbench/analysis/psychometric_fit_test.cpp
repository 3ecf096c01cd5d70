#include "workbench/analysis/psychometric_fit.h"

#include "core/base/split_mix.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

namespace tangent::analysis {
namespace {

using experiment::Psychometric;
using experiment::Staircase;
using experiment::StaircaseRule;

std::vector<ComparisonAnswer> answers_of(const Psychometric& truth, SplitMix& random, Staircase& staircase) {
  std::vector<ComparisonAnswer> out;
  while (!staircase.done()) {
    out.push_back({static_cast<double>(staircase.segments()), random.unit() < truth.right(staircase.segments())});
    staircase.answer(out.back().right);
  }
  return out;
}

TEST_CASE("with many answers the fit finds the function") {
  const Psychometric truth{80.0, 0.4, 0.02};
  SplitMix random(2);
  std::vector<ComparisonAnswer> answers;
  for (int i = 0; i < 40000; ++i) {
    const double segments = std::exp(std::log(80.0) + 3.0 * (random.unit() - 0.5));
    answers.push_back({segments, random.unit() < truth.right(segments)});
  }
  const Psychometric fit = fit_psychometric(answers);
  CHECK(fit.middle == doctest::Approx(80.0).epsilon(0.04));
  CHECK(fit.spread == doctest::Approx(0.4).epsilon(0.1));
  CHECK(fit.lapse == doctest::Approx(0.02).epsilon(0.6));
}

TEST_CASE("answers that are all right, all wrong, or one alone give finite numbers") {
  for (const bool right : {true, false}) {
    for (const int count : {1, 20}) {
      std::vector<ComparisonAnswer> answers;
      for (int i = 0; i < count; ++i) answers.push_back({10.0 + i, right});
      const Psychometric fit = fit_psychometric(answers);
      CHECK(std::isfinite(fit.middle));
      CHECK(fit.middle > 0.05);
      CHECK(fit.middle < 1e5);
      CHECK(fit.spread > 0.0);
    }
  }
}

TEST_CASE("the threshold's interval holds the truth in 95 of 100 staircases of the paper's length") {
  // Participants of different thresholds and spreads; TANGENT_STAIRCASES sets how many.
  const char* asked = std::getenv("TANGENT_STAIRCASES");
  const int participants = asked != nullptr ? std::atoi(asked) : test::rounds(120);
  StaircaseRule rule;
  rule.start = 20.0;
  SplitMix random(4);
  int held = 0;
  double bias = 0.0, said = 0.0;
  for (int i = 0; i < participants; ++i) {
    const Psychometric truth{30.0 + 100.0 * random.unit(), 0.2 + 0.3 * random.unit(), 0.02};
    Staircase staircase(rule);
    const auto answers = answers_of(truth, random, staircase);
    const FittedThreshold fit = fit_threshold(answers, rule, random.next(), 100);
    const double segments = truth.segments_at(experiment::balance_point(rule));
    held += fit.low <= segments && segments <= fit.high;
    CHECK(fit.low <= fit.segments);
    CHECK(fit.segments <= fit.high);
    bias += std::log(staircase.threshold() / segments) / participants;
    said += std::log(fit.rule_bias) / participants;
  }
  MESSAGE("held ", held, " of ", participants, "; mean of reversals over the truth ", std::exp(bias), ", as told ",
          std::exp(said));
  CHECK(held >= 0.88 * participants - 1.0);                      // 3 deviations of a share of 95 % in 120
  if (participants >= 100) CHECK(std::abs(bias - said) < 0.15);  // of a few it says nothing
}

}  // namespace
}  // namespace tangent::analysis
