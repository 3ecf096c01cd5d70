// The table fault x ticks of the OpenHaptics driver and the gate behind it, over the stub library.
#include "tests/devices/openhaptics/hd_faults.h"

#include <doctest/doctest.h>

#include <sys/resource.h>

#include <cstdio>
#include <ctime>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("openhaptics: no force within two ticks of whatever goes wrong") {
  for (const HdFault& fault : hd_faults()) {
    CAPTURE(fault.name);
    const TicksTo ticks = measure_hd_fault(fault);
    CHECK(ticks.notice >= 0);
    CHECK(ticks.notice <= fault.most_ticks);
    CHECK(ticks.zero_force >= 0);
    CHECK(ticks.zero_force <= fault.most_ticks);
  }
}

TEST_CASE("measure: faults of openhaptics" * doctest::skip()) {
  for (const HdFault& fault : hd_faults()) {
    const TicksTo ticks = measure_hd_fault(fault);
    std::printf("| %s | %d | %d |\n", fault.name, ticks.notice, ticks.zero_force);
  }
}

namespace {

struct HdTimes {
  int late = 0, lost = 0;
  std::int64_t last_ns = 0;
  double cpu_s = 0.0;
};

std::int64_t thread_cpu_ns() {
  rusage used{};
  getrusage(RUSAGE_THREAD, &used);
  return (used.ru_utime.tv_sec + used.ru_stime.tv_sec) * 1'000'000'000LL +
         (used.ru_utime.tv_usec + used.ru_stime.tv_usec) * 1'000LL;
}

void run_ticks(std::uint64_t ticks, HdTimes& times) {
  HdOptions options = stub_hd_options();
  options.last_frame_s = 60.0;
  HdLoop l(options);
  l.hd.own_thread = true;
  REQUIRE(l.device.open());
  l.loop.know_the_device();
  l.loop.before_tick = [&] {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t now_ns = now.tv_sec * 1'000'000'000LL + now.tv_nsec;
    if (times.last_ns != 0) {
      times.late += now_ns - times.last_ns > 1'500'000;
      times.lost += now_ns - times.last_ns > 2'000'000;
    }
    times.last_ns = now_ns;
    times.cpu_s = 1e-9 * static_cast<double>(thread_cpu_ns());
  };
  REQUIRE(l.device.start_calling({GateLoop::run, &l.loop}));
  l.loop.arm();
  while (l.loop.ticks < ticks) std::this_thread::yield();
  l.device.close();
  CHECK(l.hd.broken_rules == 0);
  CHECK(static_cast<std::uint64_t>(l.hd.frames.load()) >= ticks);
  CHECK(l.loop.gate_fault() == GateFault::none);
}

}  // namespace

TEST_CASE("openhaptics: each call of the library's scheduler is one tick and one frame") {
  HdTimes times;
  run_ticks(200, times);
}

TEST_CASE("measure: 10,000 ticks through openhaptics" * doctest::skip()) {
  HdTimes times;
  run_ticks(10'000, times);
  std::printf("| openhaptics | 10,000 | %d over 2 ms | %d over 1.5 ms | %.2f %% |\n", times.lost, times.late,
              100.0 * times.cpu_s / 10.0);
}
