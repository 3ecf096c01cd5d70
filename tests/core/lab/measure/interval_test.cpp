#include "core/lab/measure/interval.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace tangent;

TEST_CASE("Student's t is the tables', and beyond them the expansion joins on") {
  CHECK(student_t95(1) == doctest::Approx(12.7062));
  CHECK(student_t95(10) == doctest::Approx(2.2281));
  CHECK(student_t95(30) == doctest::Approx(2.0423));
  CHECK(student_t95(40) == doctest::Approx(2.0211).epsilon(5e-5));
  CHECK(student_t95(120) == doctest::Approx(1.9799).epsilon(5e-5));
  CHECK(std::isinf(student_t95(0)));
}

TEST_CASE("the interval of a mean by hand, of one value and of none") {
  const std::array values{1.0, 2.0, 3.0, 4.0};  // s = 1.2910, s / 2 = 0.6455, times 3.1824
  const MeanInterval interval = mean_interval(values);
  CHECK(interval.mean == doctest::Approx(2.5));
  CHECK(interval.half == doctest::Approx(2.0543).epsilon(1e-4));
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
  CHECK(ratio.ratio == doctest::Approx(1.5));
  CHECK(ratio.low == doctest::Approx(1.5));
  CHECK(ratio.high == doctest::Approx(1.5));
  of[0] *= 1.1;
  const RatioInterval wider = paired_ratio(of, to);
  CHECK(wider.low < wider.ratio);
  CHECK(wider.ratio < wider.high);
  CHECK(wider.ratio == doctest::Approx(1.5 * std::pow(1.1, 0.25)));
}
