#include "workbench/session/deadline_pacer.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("deadlines stay on the grid of the start, without adding up rounding") {
  DeadlinePacer pacer(3000.0, false);  // a period of 333,333.3 ns
  pacer.start(1'000);
  for (std::int64_t i = 1; i <= 30'000; ++i) {
    const std::int64_t exact = 1'000 + (i * 1'000'000 + 1) / 3;  // i / 3000 s, rounded
    REQUIRE(pacer.deadline_ns() == exact);
    CHECK(pacer.begin(exact).missed_deadlines == 0);
  }
}

TEST_CASE("a tick that begins late tells how late, and the next is due on the grid") {
  DeadlinePacer pacer(1000.0, false);
  pacer.start(0);
  pacer.begin(1'000'000);
  const TickTiming late = pacer.begin(2'400'000);
  CHECK(late.lateness_ns == 400'000.0);
  CHECK(late.period_ns == 1'400'000.0);
  CHECK(late.missed_deadlines == 0);
  CHECK(pacer.deadline_ns() == 3'000'000);
}

TEST_CASE("missed deadlines are skipped and counted, not caught up") {
  DeadlinePacer pacer(1000.0, false);
  pacer.start(0);
  pacer.begin(1'000'000);
  const TickTiming late = pacer.begin(6'300'000);  // due at 2 ms
  CHECK(late.missed_deadlines == 4);
  CHECK(late.lateness_ns == 4'300'000.0);
  CHECK(pacer.deadline_ns() == 7'000'000);
  CHECK(pacer.begin(7'000'000).missed_deadlines == 0);
  // On the next deadline to the nanosecond: that one is not missed but met.
  CHECK(pacer.begin(9'000'000).missed_deadlines == 1);
}

TEST_CASE("time counts ticks for simulated devices and deadlines for real ones") {
  DeadlinePacer ticks(1000.0, false), deadlines(1000.0, true);
  for (DeadlinePacer* pacer : {&ticks, &deadlines}) pacer->start(0);
  const double first = ticks.begin(1'000'000).t_s, first_deadline = deadlines.begin(1'000'000).t_s;
  const TickTiming a = ticks.begin(5'000'000), b = deadlines.begin(5'000'000);
  CHECK(a.dt_s == 1e-3);
  CHECK(a.t_s - first == approx(1e-3));
  CHECK(b.dt_s == 4e-3);
  CHECK(b.t_s - first_deadline == approx(4e-3));
}

TEST_CASE("after a pause, time goes on and the pause is not counted as missed") {
  for (const bool by_deadlines : {false, true}) {
    DeadlinePacer pacer(1000.0, by_deadlines);
    pacer.start(0);
    const TickTiming before = pacer.begin(1'000'000);
    pacer.start(900'000'000);
    CHECK(pacer.deadline_ns() == 901'000'000);
    const TickTiming after = pacer.begin(901'000'000);
    CHECK(after.missed_deadlines == 0);
    CHECK(after.period_ns == 0.0);
    CHECK(after.t_s > before.t_s);
    CHECK(after.t_s - before.t_s <= 2e-3 + 1e-12);
  }
}
