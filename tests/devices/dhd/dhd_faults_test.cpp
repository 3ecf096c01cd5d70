// The table fault x ticks of the DHD driver and the gate behind it, over the stub library.
#include "tests/devices/dhd/dhd_faults.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <sys/resource.h>

#include <cstdio>
#include <ctime>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("dhd: no force within two ticks of whatever goes wrong") {
  for (const DhdFault& fault : dhd_faults()) {
    CAPTURE(fault.name);
    const TicksTo ticks = measure_dhd_fault(fault);
    CHECK(ticks.notice >= 0);
    CHECK(ticks.notice <= fault.most_notice);
    CHECK(ticks.zero_force >= 0);
    CHECK(ticks.zero_force <= fault.most_zero);
  }
}

TEST_CASE("measure: faults of dhd" * doctest::skip()) {
  for (const DhdFault& fault : dhd_faults()) {
    const TicksTo ticks = measure_dhd_fault(fault);
    std::printf("| %s | %d | %d |\n", fault.name, ticks.notice, ticks.zero_force);
  }
}

namespace {

struct DhdTimes {
  int late = 0, lost = 0;
  double cpu_s = 0.0;
};

double thread_cpu_s() {
  rusage used{};
  getrusage(RUSAGE_THREAD, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

DhdTimes run_by_clock(int ticks) {
  DhdLoop l;
  REQUIRE(l.start());
  l.loop.arm();
  DhdTimes times;
  const double cpu_before_s = thread_cpu_s();
  timespec due{}, now{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  for (int i = 0; i < ticks; ++i) {
    due.tv_nsec += 1'000'000;
    if (due.tv_nsec >= 1'000'000'000) due.tv_sec += 1, due.tv_nsec -= 1'000'000'000;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    l.step();
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t late_ns = (now.tv_sec - due.tv_sec) * 1'000'000'000LL + now.tv_nsec - due.tv_nsec;
    times.late += late_ns > 500'000;
    times.lost += late_ns > 1'000'000;
  }
  times.cpu_s = thread_cpu_s() - cpu_before_s;
  CHECK(l.dhd.forces == ticks);
  CHECK(l.loop.gate_fault() == GateFault::none);
  CHECK(l.felt_n() == approx(ticks > 300 ? 0.5 : l.felt_n()));
  return times;
}

}  // namespace

TEST_CASE("dhd: each exchange sends one force") { run_by_clock(200); }

TEST_CASE("measure: 10,000 ticks through dhd" * doctest::skip()) {
  const DhdTimes times = run_by_clock(10'000);
  std::printf("| dhd | 10,000 | %d over 2 ms | %d over 1.5 ms | %.2f %% |\n", times.lost, times.late,
              100.0 * times.cpu_s / 10.0);
}
