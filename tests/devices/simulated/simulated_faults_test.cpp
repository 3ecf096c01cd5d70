#include "tests/devices/simulated/simulated_faults.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <ctime>
#include <string>

using namespace tangent;
using namespace tangent::testing;

namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct TimedTicks {
  int ticks = 0, late = 0;  ///< begun more than half a period late
  double wall_s = 0.0, processor_s = 0.0;
};

/// Device and gate at 1 kHz, in this thread.
TimedTicks run_in_time(int count) {
  SimulatedForceDevice device;
  static_cast<void>(device.open());
  DeviceSet set;
  set.force = std::make_unique<SimulatedForceDevice>();
  SafetyGate gate(gate_limits(set, 1000.0));
  TimedTicks run;
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  const double wall_s = seconds_of(CLOCK_MONOTONIC), processor_s = seconds_of(CLOCK_THREAD_CPUTIME_ID);
  for (; run.ticks < count; ++run.ticks) {
    due.tv_nsec += 1'000'000;
    if (due.tv_nsec >= 1'000'000'000) ++due.tv_sec, due.tv_nsec -= 1'000'000'000;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    const double due_s = static_cast<double>(due.tv_sec) + 1e-9 * static_cast<double>(due.tv_nsec);
    if (seconds_of(CLOCK_MONOTONIC) - due_s > 0.5e-3) ++run.late;
    const ForceSample sample = device.exchange({.force_n = gate.before_sending(1e-3)}, 1e-3);
    GateInput input;
    input.force_device = sample.state;
    input.position_m = sample.position_m;
    gate.pass(input, 1e-3);
  }
  run.wall_s = seconds_of(CLOCK_MONOTONIC) - wall_s;
  run.processor_s = seconds_of(CLOCK_THREAD_CPUTIME_ID) - processor_s;
  return run;
}

}  // namespace

TEST_CASE("faults of the simulated force device: zero force within two ticks of being noticed") {
  for (const SimulatedFault& fault : kSimulatedFaults) {
    const std::string name = fault.name;
    CAPTURE(name);
    const SimulatedFaultTicks ticks = ticks_after(fault);
    CHECK(ticks.noticed >= 0);
    CHECK(ticks.zero >= 0);
    CHECK(ticks.zero <= ticks.noticed + 2);
    // A reading that freezes, or is only late, may be a hand that rests, or a cable that is busy: for so long.
    const bool waits = fault.injected == InjectedFault::stuck_encoder || fault.injected == InjectedFault::delay_burst;
    if (!waits) CHECK(ticks.zero <= 2);
  }
}

TEST_CASE("measure: faults of the simulated force device" * doctest::skip()) {
  std::puts("| fault | ticks to notice | ticks to zero force |\n|---|---|---|");
  for (const SimulatedFault& fault : kSimulatedFaults) {
    const SimulatedFaultTicks ticks = ticks_after(fault);
    std::printf("| %s | %d | %d |\n", fault.name, ticks.noticed, ticks.zero);
  }
}

TEST_CASE("200 ticks at 1 kHz through the simulated force device are 200 exchanges") {
  CHECK(run_in_time(200).ticks == 200);
}

TEST_CASE("measure: 10,000 ticks through the simulated force device" * doctest::skip()) {
  const TimedTicks run = run_in_time(10'000);
  std::printf("| %d | %d late | %.2f s | %.2f %% of a core |\n", run.ticks, run.late, run.wall_s,
              100.0 * run.processor_s / run.wall_s);
}
