#include "workbench/recording/motion_numbers.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the high-pass leaves what is above its cutoff, and nothing of what stands still") {
  const auto gain = [](double hz) {
    HighPass filter(20.0, 1000.0);
    double most = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const double y = filter(5.0 + std::sin(2.0 * std::numbers::pi * hz * 1e-3 * i));
      if (i > 2000) most = std::max(most, std::abs(y));
    }
    return most;
  };
  const auto expected = [](double hz) {  // Butterworth, second order, with the bilinear transform's warped frequency
    const double ratio = std::tan(std::numbers::pi * hz / 1000.0) / std::tan(std::numbers::pi * 20.0 / 1000.0);
    return ratio * ratio / std::sqrt(1.0 + std::pow(ratio, 4));
  };
  for (const double hz : {0.0, 2.0, 10.0, 20.0, 50.0, 200.0}) {
    CAPTURE(hz);
    CHECK(gain(hz) == approx(expected(hz)).epsilon(0.02).scale(1e-3));
  }
}

TEST_CASE("quantiles are within a thirty-second of an octave") {
  Spread spread;
  for (int i = 1; i <= 10'000; ++i) spread.add(i);
  for (const double q : {0.01, 0.5, 0.99, 1.0}) CHECK(spread.quantile(q) == approx(q * 10'000).epsilon(0.03));
  CHECK(Spread{}.quantile(0.5) == 0.0);
}

TEST_CASE("jumps are counted between ticks that follow each other") {
  MotionCounter counter(1000.0);
  for (int i = 0; i < 4; ++i) {
    TickOutput output;
    output.status = i == 3 ? TickStatus::facing : TickStatus::face;
    output.force_n = Vec3(0.0, 0.0, i < 2 ? i : 10.0 + i);
    output.iterations = i;
    counter.add(output, 100.0 * (i + 1), i != 2);
  }
  const MotionNumbers numbers = counter.done();
  CHECK(numbers.ticks == 4);
  CHECK(numbers.unconverged == 1);
  CHECK(numbers.worst_force_jump_n == 1.0);  // not the 11 after the gap
  CHECK(numbers.most_force_n == 13.0);
  CHECK(numbers.mean_iterations == 1.5);
}

TEST_CASE("a buzz of 150 Hz is above 20, 50 and 100 Hz, and a way of 1 Hz is above none") {
  MotionCounter counter(1000.0);
  for (int i = 0; i < 10'000; ++i) {
    TickOutput output;
    const double t = 1e-3 * i, turn = 2.0 * std::numbers::pi * t;
    output.force_n = {std::sin(turn), 0.1 * std::sin(150.0 * turn), 0.0};
    output.cld_m = 1e-3 * std::sin(turn);
    counter.add(output, 100.0, i > 0);
  }
  const MotionNumbers numbers = counter.done();
  const double buzz = 0.1 / std::numbers::sqrt2;
  CHECK(numbers.force_above_20hz_n == approx(buzz).epsilon(0.02));
  CHECK(numbers.force_above_n[0] == approx(buzz).epsilon(0.03));
  CHECK(numbers.force_above_n[1] == approx(buzz).epsilon(0.15));
  CHECK(numbers.force_above_n[2] < 0.6 * buzz);
  CHECK(numbers.display_above_20hz_m < 5e-6);
}
