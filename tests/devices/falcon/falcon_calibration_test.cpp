#include "devices/falcon/falcon_calibration.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the Falcon's torque scale follows from what a spring scale shows") {
  // It pushes at 40 % of what it is asked for: 2.5 times the counts.
  const std::vector<FalconReading> weak{{0.25, 0.10}, {0.5, 0.20}, {0.75, 0.30}, {1.0, 0.40}};
  REQUIRE(torque_scale_from(weak, 5000.0));
  CHECK(*torque_scale_from(weak, 5000.0) == approx(12'500.0));
  // Read to 0.02 N, off by one either way: the line through them is what counts.
  const std::vector<FalconReading> rough{{0.25, 0.12}, {0.5, 0.18}, {0.75, 0.32}, {1.0, 0.40}};
  CHECK(*torque_scale_from(rough, 5000.0) == approx(12'500.0).epsilon(0.05));
  // With the scale found, the same readings as asked for find it again.
  const std::vector<FalconReading> right{{0.25, 0.25}, {0.5, 0.5}, {1.0, 1.0}};
  CHECK(*torque_scale_from(right, 12'500.0) == approx(12'500.0));
}

TEST_CASE("readings that say nothing about the Falcon's torque scale are refused") {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<FalconReading>> bad{{},
                                                    {{0.5, 0.5}, {1.0, 1.0}},
                                                    {{0.5, 0.5}, {1.0, 1.0}, {1.0, nan}},
                                                    {{0.5, 0.5}, {inf, 1.0}, {1.0, 1.0}},
                                                    {{0.5, 0.5}, {0.7, 0.0}, {1.0, 1.0}},
                                                    {{0.5, 0.5}, {-0.7, 0.7}, {1.0, 1.0}},
                                                    {{1.0, 1.0}, {1.0, 1.0}, {1.1, 1.1}},
                                                    {{0.25, 0.9}, {0.5, 0.9}, {1.0, 0.9}},
                                                    {{0.25, 25.0}, {0.5, 50.0}, {1.0, 100.0}},
                                                    {{0.25, 0.001}, {0.5, 0.002}, {1.0, 0.004}}};
  for (const auto& readings : bad) CHECK_FALSE(torque_scale_from(readings, 5000.0));
  const std::vector<FalconReading> good{{0.25, 0.25}, {0.5, 0.5}, {1.0, 1.0}};
  for (const double used : {0.0, nan, inf, 1e9}) CHECK_FALSE(torque_scale_from(good, used));
}

TEST_CASE("the guided steps ask for enough readings, each a pull, none above a newton") {
  std::vector<FalconReading> readings;
  for (const FalconScaleStep& step : falcon_scale_steps()) {
    CHECK(step.reads == (step.push_n != 0.0));
    CHECK(step.push_n <= 0.0);
    CHECK(step.push_n >= -1.0);
    if (step.reads) readings.push_back({-step.push_n, -2.0 * step.push_n});
  }
  CHECK(*torque_scale_from(readings, kFalconUncalibratedScale) == approx(2500.0));
}
