#include "workbench/session/servo.h"

#include "tests/support/approx.h"
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A servo on a fake clock that stops itself after some ticks.
struct ClockedServo {
  TickBench bench{simulated(), sphere_scene()};
  MadeUpClock clock;
  std::atomic<std::uint64_t> sleeps{0};

  /// Runs at least `ticks`; `oversleep` gives ns by number of the sleep.
  ServoStatus run(const ServoOptions& options, std::uint64_t ticks,
                  std::function<std::int64_t(std::uint64_t)> oversleep) {
    clock.oversleep_ns = [this, oversleep] { return oversleep(sleeps++); };
    Servo servo(*bench.tick, bench.statistics, options, clock);
    servo.start();
    ServoStatus status;
    do {
      std::this_thread::yield();
      bench.statistics.fill(status);
    } while (status.ticks < ticks);
    servo.stop();
    bench.statistics.fill(status);
    return status;
  }
};

ServoOptions quiet(double rate = 1000.0) {
  ServoOptions o;
  o.rate_hz = rate;
  o.realtime = false;
  return o;
}

}  // namespace

TEST_CASE("a servo whose clock keeps its deadlines is never late, and measures its rate") {
  for (const double rate : {100.0, 1000.0, 10'000.0}) {
    ClockedServo s;
    const ServoStatus status =
        s.run(quiet(rate), static_cast<std::uint64_t>(3.0 * rate), [](std::uint64_t) { return 0; });
    CHECK(status.late_ticks == 0);
    CHECK(status.missed_deadlines == 0);
    CHECK(status.lateness_worst_ns == 0.0);
    CHECK(status.rate_hz == approx(rate).epsilon(1e-6));
  }
}

TEST_CASE("late ticks and skipped deadlines are counted, each once") {
  ClockedServo s;
  // Every 100th sleep is 3.5 ms too long: three deadlines pass unserved, then ticks are on the grid again.
  const ServoStatus status = s.run(quiet(), 1000, [](std::uint64_t n) { return n % 100 == 50 ? 3'500'000 : 0; });
  const std::uint64_t sleeps = s.sleeps;
  const std::uint64_t overslept = (status.ticks + 49) / 100;
  // A tick for every sleep, none in a burst; but for the last, after which it may be told to end.
  CHECK(status.ticks <= sleeps);
  CHECK(status.ticks + 1 >= sleeps);
  CHECK(status.late_ticks == overslept);
  CHECK(status.missed_deadlines == 3 * overslept);
  CHECK(status.lateness_worst_ns == 3'500'000.0);
}

TEST_CASE("a tick a little late misses nothing") {
  ClockedServo s;
  const ServoStatus status = s.run(quiet(), 500, [](std::uint64_t n) { return n % 2 == 0 ? 400'000 : 0; });
  CHECK(status.late_ticks == 0);
  CHECK(status.lateness_worst_ns == 400'000.0);
}

TEST_CASE("records that find the ring full are counted as drops") {
  ClockedServo s;
  const ServoStatus status = s.run(quiet(), 6000, [](std::uint64_t) { return 0; });
  CHECK(s.bench.channels.gui.drops() == status.ticks - 4096);
  ServoRecord record;
  for (std::uint64_t tick = 0; tick < 4096; ++tick) {
    REQUIRE(s.bench.channels.gui.pop(record));
    CHECK(record.tick.tick == tick);
  }
  CHECK_FALSE(s.bench.channels.gui.pop(record));
}

TEST_CASE("a stopped servo starts again and goes on counting") {
  TickBench bench(simulated(), sphere_scene());
  MonotonicClock clock;
  Servo servo(*bench.tick, bench.statistics, quiet(), clock);
  std::uint64_t last = 0;
  for (int round = 0; round < 3; ++round) {
    CHECK_FALSE(servo.running());
    servo.start();
    servo.start();
    CHECK(servo.running());
    ServoStatus status;
    do {
      std::this_thread::yield();
      bench.statistics.fill(status);
    } while (status.ticks < last + 20);
    servo.stop();
    servo.stop();
    bench.statistics.fill(status);
    last = status.ticks;
  }
  ServoRecord record;
  for (std::uint64_t tick = 0; tick < last; ++tick) {
    REQUIRE(bench.channels.gui.pop(record));
    CHECK(record.tick.tick == tick);
  }
}
