#include "workbench/session/call_pacer.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("ticks that a device calls have the time between the calls") {
  CallPacer pacer(1000.0);
  pacer.start();
  std::int64_t now = 5'000'000'000;
  const TickTiming first = pacer.begin(now);
  CHECK(first.dt_s == approx(1e-3));
  CHECK(first.period_ns == 0.0);
  double t = first.t_s;
  for (const std::int64_t gap : {1'000'000, 900'000, 1'100'000, 1'499'000}) {
    now += gap;
    const TickTiming tick = pacer.begin(now);
    CHECK(tick.dt_s == approx(static_cast<double>(gap) * 1e-9).epsilon(1e-12));
    CHECK(tick.t_s - t == approx(tick.dt_s).epsilon(1e-12));
    CHECK(tick.missed_deadlines == 0);
    t = tick.t_s;
  }
}

TEST_CASE("a call that comes periods late counts them as missed, and never gives a time step of zero") {
  CallPacer pacer(1000.0);
  pacer.start();
  pacer.begin(1'000'000'000);
  const TickTiming late = pacer.begin(1'004'400'000);
  CHECK(late.missed_deadlines == 3);
  CHECK(late.lateness_ns == approx(3.4e6));
  const TickTiming twice = pacer.begin(1'004'400'000);
  CHECK(twice.dt_s > 0.0);
  CHECK(twice.missed_deadlines == 0);
}

TEST_CASE("time goes on over a pause in the calls, without it") {
  CallPacer pacer(2000.0);
  pacer.start();
  pacer.begin(1'000'000'000);
  const TickTiming before = pacer.begin(1'000'500'000);
  pacer.start();
  const TickTiming after = pacer.begin(9'000'000'000);
  CHECK(after.t_s - before.t_s == approx(5e-4));
  CHECK(after.missed_deadlines == 0);
}
