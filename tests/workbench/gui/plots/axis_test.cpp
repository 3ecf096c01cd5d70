#include "tests/support/approx.h"
#include "workbench/gui/plots/tick_locator.h"
#include "workbench/gui/plots/time_axis.h"
#include "workbench/gui/plots/value_axis.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

std::vector<std::string> labels(const std::vector<AxisTick>& ticks) {
  std::vector<std::string> out;
  for (const AxisTick& tick : ticks) {
    if (tick.major) out.push_back(tick.label);
  }
  return out;
}

}  // namespace

TEST_CASE("linear ticks fall on 1, 2 or 5 times a power of ten, with just the decimals they need") {
  CHECK(labels(linear_ticks(0.0, 1.0, 5)) == std::vector<std::string>{"0", "0.2", "0.4", "0.6", "0.8", "1.0"});
  CHECK(labels(linear_ticks(-3.0, 12.0, 4)) == std::vector<std::string>{"0", "5", "10"});
  CHECK(labels(linear_ticks(1234.5, 1235.5, 4)) == std::vector<std::string>{"1234.5", "1235.0", "1235.5"});
  CHECK(labels(linear_ticks(-0.02, 0.021, 4)) == std::vector<std::string>{"-0.02", "0", "0.02"});
}

TEST_CASE("an axis that is two lines high has labels at two places, a lower one where they are a line apart") {
  CHECK(labels(value_ticks({-0.3, 0.0, false, false, 1.3})) == std::vector<std::string>{"-0.2", "0"});
  CHECK(labels(value_ticks({0.0, 1.25, false, true, 3.0})) == std::vector<std::string>{"0", "1"});
  CHECK(labels(value_ticks({1e-7, 2.0, true, false, 3.0})).size() == 2);
  CHECK(labels(value_ticks({0.0, 1.0, false, false, 0.5})).size() <= 1);
  CHECK(labels(value_ticks({0.0, 1.0, false, false, 12.0})) == labels(linear_ticks(0.0, 1.0, 5)));
  for (double low : {-17.3, 0.0, 1e-9, 123.456})
    for (double range = 1e-6; range < 1e6; range *= 3.7)
      for (double lines = 2.0; lines < 30.0; lines *= 1.4)
        REQUIRE(labels(value_ticks({low, low + range, false, false, lines})).size() >= 2);
}

TEST_CASE("no more labels than asked for, whatever the range") {
  for (double low : {-1e6, -17.3, 0.0, 1e-9, 123456.789}) {
    for (double range = 1e-9; range < 1e9; range *= 3.7) {
      for (int most : {1, 2, 3, 5, 9}) {
        if (low != 0.0 && range / std::abs(low) < 1e-9) continue;
        const auto ticks = labels(linear_ticks(low, low + range, most));
        REQUIRE(static_cast<int>(ticks.size()) <= most + 1);
      }
    }
  }
}

TEST_CASE("every label of a linear axis reads back as its tick") {
  for (double range = 1e-4; range < 1e5; range *= 1.9) {
    for (const AxisTick& tick : linear_ticks(-0.3 * range, 0.7 * range, 6)) {
      if (!tick.major) continue;
      REQUIRE(std::abs(std::stod(tick.label) - tick.value) <= 1e-9 * range);
    }
  }
}

TEST_CASE("a range that isn't one has no ticks") {
  CHECK(linear_ticks(1.0, 1.0, 5).empty());
  CHECK(linear_ticks(2.0, 1.0, 5).empty());
  CHECK(linear_ticks(NAN, 1.0, 5).empty());
  CHECK(log_ticks(0.0, 1.0, 5).empty());
  CHECK(log_ticks(-1.0, 1.0, 5).empty());
}

TEST_CASE("log ticks label decades and thin them out when there are many") {
  CHECK(labels(log_ticks(0.01, 100.0, 6)) == std::vector<std::string>{"0.01", "0.1", "1", "10", "100"});
  const auto thin = labels(log_ticks(1e-9, 1e3, 4));
  CHECK(thin.size() <= 5);
  CHECK(thin.size() >= 3);
  int minor = 0;
  for (const AxisTick& tick : log_ticks(1.0, 10.0, 6)) minor += tick.major ? 0 : 1;
  CHECK(minor == 8);
}

TEST_CASE("zooming about the pointer keeps the tick under it") {
  TimeAxis axis;
  axis.update(0, 100'000, 1e6);
  axis.show(20'000, 40'000);
  for (const double x : {100.0, 333.0, 900.0}) {
    for (const double factor : {0.8, 1.25, 0.5}) {
      const double before = axis.tick_at(x, 100.0, 800.0);
      axis.zoom(factor, before);
      CHECK(axis.tick_at(x, 100.0, 800.0) == approx(before).epsilon(1e-12));
    }
  }
}

TEST_CASE("a following axis keeps its right end on the newest tick, also while zooming - panning lets go") {
  TimeAxis axis;
  axis.update(0, 10'000, 1e6);
  CHECK(axis.to() == 10'000.0);
  axis.zoom(0.5, 9'000.0);
  CHECK(axis.to() == 10'000.0);
  const double span = axis.span();
  axis.pan(-500.0);
  axis.update(0, 11'000, 1e6);
  CHECK(axis.to() == 9'500.0);
  axis.follow();
  axis.update(0, 12'000, 1e6);
  CHECK(axis.to() == 12'000.0);
  CHECK(axis.span() == span);
}

TEST_CASE("the time axis never shrinks below a few ticks nor grows past what is kept") {
  TimeAxis axis;
  axis.update(0, 10'000, 60'000);
  for (int i = 0; i < 200; ++i) axis.zoom(0.5, 5'000.0);
  CHECK(axis.span() == TimeAxis::kLeastSpan);
  for (int i = 0; i < 200; ++i) axis.zoom(2.0, 5'000.0);
  CHECK(axis.span() == 60'000.0);
}

TEST_CASE("the value axis grows at once and shrinks only when much room is spare") {
  ValueAxis axis;
  axis.fit_linear({0.0f, 9.0f}, true);
  CHECK(axis.high() >= 9.0);
  const double high = axis.high();
  axis.fit_linear({0.0f, 0.8f * static_cast<float>(high)}, true);
  CHECK(axis.high() == high);
  axis.fit_linear({0.0f, 1.0f}, true);
  CHECK(axis.high() < high);
  axis.fit_linear({-3.0f, 100.0f}, true);
  CHECK(axis.high() >= 100.0);
  CHECK(axis.low() <= -3.0);
}

TEST_CASE("zooming values by hand keeps the value under the pointer and stops the fitting") {
  ValueAxis axis;
  axis.fit_linear({-2.0f, 6.0f}, true);
  const double share = axis.share(1.5, false);
  axis.zoom(0.5, 1.5, false);
  CHECK(axis.share(1.5, false) == approx(share));
  axis.fit_linear({-100.0f, 100.0f}, true);
  CHECK(axis.share(1.5, false) == approx(share));
  ValueAxis log;
  log.fit_log({0.001f, 50.0f}, 1e-6);
  const double log_share = log.share(0.1, true);
  log.zoom(0.7, 0.1, true);
  CHECK(log.share(0.1, true) == approx(log_share));
  CHECK(log.value_at(log_share, true) == approx(0.1));
}

TEST_CASE("a log axis holds zero, negative and enormous values") {
  ValueAxis axis;
  axis.fit_log({0.0f, 0.0f}, 1e-6);
  CHECK(axis.low() > 0.0);
  CHECK(axis.high() > axis.low());
  CHECK(axis.share(0.0, true) == 0.0);
  CHECK(axis.share(-5.0, true) == 0.0);
  CHECK(axis.share(static_cast<double>(NAN), true) == 0.0);
}
