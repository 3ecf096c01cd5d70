#include "workbench/bench/tick_clock.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tangent::bench;

TEST_CASE("the clock of single ticks runs at the rate of the system's") {
  const TickClock clock;
  CHECK(clock.overhead_ns() >= 0.0);
  // The best of a few: an interruption between two readings spoils one.
  double closest = 1e300;
  for (int i = 0; i < 100 && closest > 1e-3; ++i) {
    const std::int64_t began = TickClock::now(), from = clock.mark();
    while (TickClock::now() - began < 5'000'000) {}
    const std::int64_t to = clock.mark(), ended = TickClock::now();
    closest = std::min(closest, std::abs(clock.elapsed_ns(from, to) / static_cast<double>(ended - began) - 1.0));
  }
  CHECK(closest < 1e-3);
}

TEST_CASE("marks never go back") {
  const TickClock clock;
  std::int64_t last = clock.mark();
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t mark = clock.mark();
    CHECK(mark >= last);
    last = mark;
  }
}
