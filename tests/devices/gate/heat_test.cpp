#include "devices/gate/heat.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("peak force may be held for the stated time, then the motors' heat allows the continuous force") {
  constexpr double dt = 1e-3;
  ForceBudget budget;
  CHECK(budget.allowed(8.5, 1.4) == 8.5);
  double seconds_at_peak = 0.0;
  for (int i = 0; i < 60'000; ++i) {
    const double force = budget.allowed(8.5, 1.4);
    if (force == 8.5) seconds_at_peak += dt;
    budget.spend(force, 8.5, 1.4, dt);
  }
  CHECK(seconds_at_peak == approx(0.5 * ForceBudget::kPeakHold_s).epsilon(0.01));
  CHECK(budget.allowed(8.5, 1.4) == approx(1.4).epsilon(0.01));
  for (int i = 0; i < 200'000; ++i) budget.spend(0.0, 8.5, 1.4, dt);  // cools
  CHECK(budget.allowed(8.5, 1.4) == 8.5);
  for (int i = 0; i < 600'000; ++i) budget.spend(1.4, 8.5, 1.4, dt);  // for ever
  CHECK(budget.allowed(8.5, 1.4) == 8.5);
  CHECK(ForceBudget{}.allowed(8.5, 0.0) == 8.5);  // not known: no limit of its own
}

TEST_CASE("motors that were hot when their device was closed are as hot when it is opened, less what they cooled") {
  constexpr std::int64_t second = 1'000'000'000;
  HeatMemory memory;
  CHECK(memory.recall("arm 7", 1.4, 0) == 0.0);
  memory.keep("arm 7", 60.0, 5 * second);
  CHECK(memory.recall("arm 7", 1.4, 5 * second) == 60.0);
  CHECK(memory.recall("arm 7", 1.4, 15 * second) == approx(60.0 - 10.0 * 1.4 * 1.4));
  CHECK(memory.recall("arm 7", 1.4, 500 * second) == 0.0);
  CHECK(memory.recall("arm 8", 1.4, 5 * second) == 0.0);
  memory.keep("arm 7", 3.0, 6 * second);
  CHECK(memory.recall("arm 7", 0.0, 600 * second) == 3.0);  // nothing known of how they cool
}
