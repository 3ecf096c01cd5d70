// The force of the last seconds in even steps.
#include "workbench/gui/experiment/force_trace.h"

#include "tests/support/approx.h"
#include "workbench/gui/platform/experiment_monitor.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a step of the trace is the largest force of its ticks, the newest last") {
  ForceTrace trace(1.0, 10);
  CHECK(trace.values() == std::vector<float>(10, 0.0f));
  for (int tick = 0; tick < 2000; ++tick) trace.add(1e-3 * tick + 5e-4, tick % 100 == 50 ? 0.001 * tick : 0.0);
  const std::vector<float> values = trace.values();
  REQUIRE(values.size() == 10);
  for (int i = 0; i < 10; ++i) CHECK(values[static_cast<std::size_t>(i)] == approx(1.05 + 0.1 * i));
}

TEST_CASE("a gap in the trace is empty, and a clock that goes back begins it anew") {
  ForceTrace trace(1.0, 10);
  trace.add(0.05, 1.0);
  trace.add(0.55, 2.0);
  std::vector<float> values = trace.values();
  CHECK(values[9] == 2.0f);
  CHECK(values[4] == 1.0f);
  CHECK(std::count(values.begin(), values.end(), 0.0f) == 8);
  trace.add(100.0, 3.0);
  values = trace.values();
  CHECK(std::count(values.begin(), values.end(), 0.0f) == 9);
  trace.add(0.0, 4.0);
  values = trace.values();
  CHECK(values[9] == 4.0f);
  CHECK(std::count(values.begin(), values.end(), 0.0f) == 9);
}

TEST_CASE("the participant's window goes to a monitor of its own, where there is one") {
  const MonitorPlace first{0, 0, 1920, 1080}, right{1920, 0, 1280, 1024}, same{0, 0, 1280, 720};
  CHECK_FALSE(participant_monitor(std::array{first}, 0));
  CHECK(participant_monitor(std::array{first, right}, 0) == 1u);
  CHECK(participant_monitor(std::array{first, right}, 1) == 0u);
  CHECK_FALSE(participant_monitor(std::array{first, same}, 0));  // both show the same
  CHECK(participant_monitor(std::array{first, same, right}, 0) == 2u);
  CHECK_FALSE(participant_monitor({}, 0));
}
