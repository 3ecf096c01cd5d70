#include "core/lab/measure/interval.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("Student's t is the tables', and beyond them the expansion joins on") {
  CHECK(student_t95(1) == approx(12.7062));
  CHECK(student_t95(10) == approx(2.2281));
  CHECK(student_t95(30) == approx(2.0423));
  CHECK(student_t95(40) == approx(2.0211).epsilon(5e-5));
  CHECK(student_t95(120) == approx(1.9799).epsilon(5e-5));
  CHECK(std::isinf(student_t95(0)));
}

TEST_CASE("the interval of a mean by hand, of one value and of none") {
  const std::array values{1.0, 2.0, 3.0, 4.0};  // s = 1.2910, s / 2 = 0.6455, times 3.1824
  const MeanInterval interval = mean_interval(values);
  CHECK(interval.mean == approx(2.5));
  CHECK(interval.half == approx(2.0543).epsilon(1e-4));
  CHECK(std::isinf(mean_interval(std::span(values).first(1)).half));
  CHECK(mean_interval({}).count == 0);
}

TEST_CASE("the interval holds the mean in 95 of 100 samples") {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(7.0, 2.0);
  int held = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values(6);
    for (double& value : values) value = normal(random);
    const MeanInterval interval = mean_interval(values);
    held += interval.low() <= 7.0 && 7.0 <= interval.high() ? 1 : 0;
  }
  CHECK(held > 0.94 * kTrials);
  CHECK(held < 0.96 * kTrials);
}

TEST_CASE("what slows both of a pair down leaves their ratio and its interval as they are") {
  const std::array to{100.0, 300.0, 120.0, 900.0};
  std::array<double, 4> of{};
  for (std::size_t i = 0; i < to.size(); ++i) of[i] = 1.5 * to[i];
  const RatioInterval ratio = paired_ratio(of, to);
  CHECK(ratio.ratio == approx(1.5));
  CHECK(ratio.low == approx(1.5));
  CHECK(ratio.high == approx(1.5));
  of[0] *= 1.1;
  const RatioInterval wider = paired_ratio(of, to);
  CHECK(wider.low < wider.ratio);
  CHECK(wider.ratio < wider.high);
  CHECK(wider.ratio == approx(1.5 * std::pow(1.1, 0.25)));
}

TEST_CASE("the interval of a median by order statistics - ranks and coverage by hand, and it holds the median") {
  std::vector<double> values;
  for (int i = 12; i >= 1; --i) values.push_back(i);
  const MedianInterval twelve = median_interval(values);  // 2 (1 + 12 + 66) / 4096 missed
  CHECK(twelve.median == 6.5);
  CHECK(twelve.low == 3.0);
  CHECK(twelve.high == 10.0);
  CHECK(twelve.coverage == approx(1.0 - 158.0 / 4096.0));
  const MedianInterval five = median_interval({5.0, 1.0, 4.0, 2.0, 3.0});
  CHECK(five.median == 3.0);
  CHECK(five.low == 1.0);
  CHECK(five.high == 5.0);
  CHECK(five.coverage == approx(1.0 - 2.0 / 32.0));
  CHECK(median_interval({7.0}).coverage == 0.0);
  CHECK(median_interval({7.0}).high == 7.0);
  CHECK(median_interval({}).count == 0);

  std::mt19937_64 random(11);
  std::lognormal_distribution<double> skewed(0.0, 1.0);  // median 1
  int held = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> drawn(9);
    for (double& value : drawn) value = skewed(random);
    const MedianInterval interval = median_interval(drawn);
    held += interval.low <= 1.0 && 1.0 <= interval.high ? 1 : 0;
  }
  // 9 values: coverage 0.961, three standard errors of it 0.013.
  CHECK(held > kTrials * 0.945);
  CHECK(held < kTrials * 0.977);
}
