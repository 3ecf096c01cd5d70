#include "workbench/experiment/staircase.h"

#include "workbench/experiment/psychometric.h"

#include "core/base/split_mix.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace tangent::experiment {

using test::approx;
namespace {

/// Answers, r right and w wrong, and the levels that were shown.
std::vector<int> levels_for(const StaircaseRule& rule, std::string_view answers) {
  Staircase staircase(rule);
  std::vector<int> out;
  for (const char answer : answers) {
    out.push_back(staircase.segments());
    staircase.answer(answer == 'r');
  }
  out.push_back(staircase.segments());
  return out;
}

TEST_CASE("one wrong answer makes it easier, two right ones in a row harder") {
  StaircaseRule rule;
  rule.scale = StepScale::segments;
  rule.start = 20;
  rule.large_step = 8;
  rule.small_step = 2;
  rule.large_reversals = 1;
  //                                          r   r   r   w   r   w   r   r   r   r
  const std::vector<int> expected{20, 20, 28, 28, 20, 20, 18, 18, 20, 20, 22};
  CHECK(levels_for(rule, "rrrwrwrrrr") == expected);
}

TEST_CASE("reversals are the levels where it turned, large steps end with the third") {
  StaircaseRule rule;
  rule.start = 16.0;
  rule.large_step = 2.0;
  rule.small_step = 1.25;
  Staircase staircase(rule);
  const auto answer = [&](std::string_view answers) {
    for (const char a : answers) staircase.answer(a == 'r');
  };
  answer("rr");  // 16 -> 32
  answer("w");   // turns at 32 -> 16
  answer("rr");  // turns at 16 -> 32
  CHECK(staircase.segments() == 32);
  answer("w");  // the third turn, at 32, still a large step -> 16
  CHECK(staircase.segments() == 16);
  answer("w");  // the same way, a small step
  CHECK(staircase.segments() == 13);
  CHECK(staircase.reversals() == std::vector<double>{32.0, 16.0, 32.0});
  CHECK_FALSE(staircase.done());
}

TEST_CASE("eleven reversals end it, the last six are the threshold") {
  StaircaseRule rule;
  rule.scale = StepScale::segments;
  rule.start = 50;
  rule.large_step = rule.small_step = 10;
  Staircase staircase(rule);
  while (!staircase.done()) {
    staircase.answer(true);
    if (staircase.done()) break;
    staircase.answer(true);
    if (!staircase.done()) staircase.answer(false);
  }
  CHECK(staircase.settled());
  CHECK(staircase.reversals().size() == 11);
  CHECK(staircase.threshold() == approx(55.0));
}

TEST_CASE("every step shows another number of segments, but at the ends") {
  // 3 segments times the shipped small step of 1.15 are 3.45, and would be shown as 3 once more.
  StaircaseRule rule;
  rule.start = 3;
  rule.fewest = 3;
  rule.most = 40;
  rule.large_reversals = 0;
  rule.small_step = 1.15;
  rule.down = 1;
  CHECK(levels_for(rule, "rrrrrwwwwww") == std::vector<int>{3, 4, 5, 6, 7, 8, 7, 6, 5, 4, 3, 3});
  for (const StepScale scale : {StepScale::ratio, StepScale::segments}) {
    rule.scale = scale;
    for (const double step : {1.01, 1.15, 1.4}) {
      rule.small_step = scale == StepScale::ratio ? step : step - 0.9;
      rule.reversals = 1000;
      Staircase staircase(rule);
      SplitMix random(6);
      for (int i = 0; i < 300; ++i) {
        const int shown = staircase.segments();
        const bool right = random.unit() < 0.6;
        staircase.answer(right);
        CAPTURE(shown);
        if (shown == (right ? 40 : 3))
          CHECK(staircase.segments() == shown);
        else
          CHECK((right ? staircase.segments() > shown : staircase.segments() < shown));
      }
    }
  }
}

TEST_CASE("it stays within its ends, and one that never turns is ended") {
  StaircaseRule rule;
  rule.start = 4;
  rule.fewest = 3;
  rule.most = 9;
  rule.most_trials = 60;
  Staircase up(rule), down(rule);
  while (!up.done()) up.answer(true);
  while (!down.done()) down.answer(false);
  CHECK(up.segments() == 9);
  CHECK(down.segments() == 3);
  CHECK(up.trials() == 60);
  CHECK_FALSE(up.settled());
}

TEST_CASE("with small steps it stays where seven of ten answers are right") {
  // Levitt's 70.7 %: the share of right answers over long runs.
  CHECK(balance_point(StaircaseRule{}) == approx(0.70710678));
  StaircaseRule rule;
  rule.small_step = rule.large_step = 1.03;
  rule.reversals = 2000;
  rule.most_trials = 200000;
  const Psychometric participant{80.0, 0.35, 0.02};
  SplitMix random(7);
  Staircase staircase(rule);
  double right = 0.0, sum = 0.0;
  while (!staircase.done()) {
    const double chance = participant.right(staircase.segments());
    sum += chance;
    const bool answer = random.unit() < chance;
    right += answer;
    staircase.answer(answer);
  }
  MESSAGE("right: ", right / staircase.trials(), " of ", staircase.trials());
  CHECK(sum / staircase.trials() == approx(0.7071).epsilon(0.01));
}

TEST_CASE("measure: where the rule settles, by steps" * doctest::skip()) {
  constexpr int kParticipants = 2000;
  for (const double large : {2.0, 1.6, 1.4}) {
    for (const double small : {1.1, 1.15, 1.2, 1.3}) {
      StaircaseRule rule;
      rule.start = 26.0;
      rule.large_step = large;
      rule.small_step = small;
      std::vector<double> over;
      double trials = 0.0;
      for (std::uint64_t p = 0; p < kParticipants; ++p) {
        SplitMix random(p, 7);
        Psychometric participant{1.0, 0.35, 0.02};
        participant.middle = 104.1 / participant.segments_at(balance_point(rule));
        Staircase staircase(rule);
        while (!staircase.done()) staircase.answer(random.unit() < participant.right(staircase.segments()));
        trials += staircase.trials();
        over.push_back(staircase.threshold() / 104.1);
      }
      double mean = 0.0, squares = 0.0;
      for (const double value : over) mean += value / kParticipants;
      for (const double value : over) squares += (value - mean) * (value - mean) / kParticipants;
      std::sort(over.begin(), over.end());
      MESSAGE("steps ", large, ", ", small, ": mean over the threshold ", mean, ", median ", over[kParticipants / 2],
              ", deviation ", std::sqrt(squares), ", 99th percentile ", over[kParticipants * 99 / 100], ", trials ",
              trials / kParticipants);
    }
  }
}

TEST_CASE("the psychometric function falls from right to guessing, and is undone") {
  const Psychometric function{80.0, 0.35, 0.02};
  CHECK(function.right(0.01) == approx(0.98));
  CHECK(function.right(1e9) == approx(0.5));
  CHECK(function.right(80.0) == approx(0.74));
  for (const double right : {0.55, 0.7071, 0.9}) CHECK(function.right(function.segments_at(right)) == approx(right));
}

}  // namespace
}  // namespace tangent::experiment
