#include "devices/gate/freshness.h"

#include <doctest/doctest.h>

using namespace tangent;

namespace {

/// Ticks until one tick in `every` that misses `missed` deadlines is too much; 0: never in 10 s.
int ticks_until_too_many(double rate_hz, int every, int missed) {
  LatenessWatch watch;
  const double period = 1.0 / rate_hz;
  for (int tick = 1; tick < 10.0 * rate_hz; ++tick) {
    if (watch.add(tick % every == 0 ? (1 + missed) * period : period, period)) return tick;
  }
  return 0;
}

}  // namespace

TEST_CASE("a tenth of the ticks late is too many within a tenth of a second, fewer never are") {
  for (const double rate : {300.0, 1000.0, 4000.0, 10'000.0}) {
    CAPTURE(rate);
    const int found = ticks_until_too_many(rate, 8, 1);
    CHECK(found > 0);
    CHECK(found <= static_cast<int>(0.11 * rate));
    CHECK(ticks_until_too_many(rate, 15, 1) == 0);
  }
}

TEST_CASE("at 100 Hz one late tick is none too many, three in a tenth of a second are") {
  CHECK(ticks_until_too_many(100.0, 11, 1) == 0);
  CHECK(ticks_until_too_many(100.0, 2, 1) > 0);
}

TEST_CASE("a watch that forgot counts from nothing") {
  LatenessWatch watch;
  for (int i = 0; i < 9; ++i) CHECK_FALSE(watch.add(2e-3, 1e-3));
  watch.forget();
  for (int i = 0; i < 9; ++i) CHECK_FALSE(watch.add(2e-3, 1e-3));
  CHECK(watch.add(2e-3, 1e-3));
}
