// What a Falcon costs: allocations, processor time, false alarms.
#include "devices/plugin/host/allocation_watch.h"
#include "tests/devices/usb/falcon_bench.h"

#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

#include <dirent.h>

using namespace tangent;
using namespace tangent::emulation;

namespace {

/// Processor time of this process's thread of that name, s.
double thread_s(const std::string& name) {
  double seconds = 0.0;
  DIR* tasks = ::opendir("/proc/self/task");
  while (const dirent* entry = tasks != nullptr ? ::readdir(tasks) : nullptr) {
    const std::string folder = std::string("/proc/self/task/") + entry->d_name;
    std::string found;
    double ns = 0.0;
    if (std::ifstream(folder + "/comm") >> found && found == name && std::ifstream(folder + "/schedstat") >> ns)
      seconds += 1e-9 * ns;
  }
  if (tasks != nullptr) ::closedir(tasks);
  return seconds;
}

double clock_s(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

TEST_CASE("Falcon: no exchange allocates: homing, pushing, faults, unplugged, plugged in, loading its firmware") {
  const Bytes firmware = falcon_firmware_of(1300);
  FalconOptions options;
  options.kept["F00001"] = {10'000.0, "", ""};
  FalconRig rig(options, firmware);
  rig.model.running = false;
  std::size_t in_exchanges = 0, exchanges = 0;
  const auto run = [&](int ticks, DeviceRequest request = DeviceRequest::none) {
    for (int i = 0; i < ticks; ++i) {
      rig.servo_runs = false;
      rig.tick();  // device and link
      count_allocations();
      rig.sample = rig.driver.exchange({.force_n = Vec3(0.0, 0.0, 1.0), .request = request}, rig.now_ns);
      in_exchanges += counted_allocations();
      ++exchanges;
    }
  };
  run(10);
  rig.plug_in();
  run(2000);
  REQUIRE(rig.model.uploads == 1);
  REQUIRE(rig.sample.state == DeviceState::ready);
  REQUIRE(rig.model.pushes());
  for (const FalconFault fault : {FalconFault::silent, FalconFault::garbage, FalconFault::cut, FalconFault::far_away,
                                  FalconFault::legs_apart, FalconFault::unhomed, FalconFault::frozen}) {
    rig.model.fault = fault;
    run(30);
    rig.model.fault = FalconFault::none;
    run(10);
    run(1, DeviceRequest::clear_fault);
    run(100);
    CHECK(rig.sample.state == DeviceState::ready);
  }
  rig.driver.stop();
  run(10);
  rig.unplug();
  run(10);
  CHECK(rig.sample.state == DeviceState::absent);
  rig.plug_in();
  run(2000);
  CHECK(rig.sample.state == DeviceState::faulted);  // the stop holds
  CHECK(exchanges > 4000);
  CHECK(in_exchanges == 0);
}

TEST_CASE("measure: 10,000 ticks through falcon" * doctest::skip()) {
  FalconOptions options;
  options.torque_counts_per_nm = 10'000.0;
  FalconBench b(options);
  b.model.answers_at_once = false;  // as the chip's latency of 1 ms has it
  b.begin();
  b.make_ready();
  constexpr int kTicks = 10'000;
  const std::uint64_t answers = b.report().frames, lost = b.report().lost;
  const double servo = clock_s(CLOCK_THREAD_CPUTIME_ID), link = thread_s("usb"), wall = clock_s(CLOCK_MONOTONIC);
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  int late = 0, not_ready = 0, old = 0, without = 0, faults = 0;
  std::uint64_t unanswered = 0;  // of the faults: the device's silence, by the link; the rest is a thread's
  std::size_t allocated = 0;
  for (int i = 0; i < kTicks; ++i) {
    count_allocations();
    const bool faulted = b.sample.state == DeviceState::faulted;
    b.exchange({0.0, 0.0, 0.5 + 0.4 * std::sin(0.01 * i)},
               faulted && i % 10 == 0 ? DeviceRequest::clear_fault : DeviceRequest::none);
    allocated += counted_allocations();
    without += b.sample.force_n == Vec3(0.0);
    if (!faulted && b.sample.state == DeviceState::faulted) {
      ++faults;
      unanswered += b.sample.age_s <= options.silence_s;
    }
    not_ready += b.sample.state != DeviceState::ready;
    old += b.sample.age_s > 3e-3;
    due.tv_nsec += 1'000'000;
    if (due.tv_nsec >= 1'000'000'000) {
      due.tv_nsec -= 1'000'000'000;
      ++due.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    late += static_cast<double>(now.tv_sec - due.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - due.tv_nsec) > 1e-3;
  }
  const double took = clock_s(CLOCK_MONOTONIC) - wall;
  MESSAGE("answers " << b.report().frames - answers << ", commands without an answer in 3 ms " << b.report().lost - lost
                     << ", samples older than 3 ms " << old << ", faults " << faults
                     << ", of them by two commands without an answer " << unanswered << ", ticks not ready "
                     << not_ready << ", ticks without force " << without << ", allocations " << allocated
                     << ", ticks late by 1 ms " << late << "; link's thread " << 100.0 * (thread_s("usb") - link) / took
                     << " % of a core, exchange and its clock "
                     << 100.0 * (clock_s(CLOCK_THREAD_CPUTIME_ID) - servo) / took << " %");
}

// The emulated device shares the machine's processors, so an answer is late more often here than on a cable.
TEST_CASE("measure: false alarms of falcon" * doctest::skip()) {
  constexpr std::array<double, 5> kAnswer_ms{1.5, 2.0, 3.0, 4.0, 6.0};
  std::printf("| answer within | commands | not answered in time | two in a row |\n|---|---|---|---|\n");
  for (const double answer_ms : kAnswer_ms) {
    FalconOptions options = FalconBench::patient();
    options.line.answer_s = 1e-3 * answer_ms;
    FalconBench b(options);
    b.model.answers_at_once = false;
    b.begin();
    REQUIRE(eventually([&] {
      const bool faulted = b.sample.state == DeviceState::faulted;
      return b.exchange(Vec3(0.0), faulted ? DeviceRequest::clear_fault : DeviceRequest::none).state ==
             DeviceState::ready;
    }));
    const std::uint64_t answers = b.report().frames, lost = b.report().lost;
    int faults = 0;
    timespec due{};
    clock_gettime(CLOCK_MONOTONIC, &due);
    for (int i = 0; i < 5000; ++i) {
      const bool faulted = b.sample.state == DeviceState::faulted;
      faults += faulted;
      b.exchange({0.0, 0.0, 0.5}, faulted ? DeviceRequest::clear_fault : DeviceRequest::none);
      due.tv_nsec += 1'000'000;
      if (due.tv_nsec >= 1'000'000'000) {
        due.tv_nsec -= 1'000'000'000;
        ++due.tv_sec;
      }
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    }
    const LinkReport r = b.report();
    std::printf("| %.1f ms | %llu | %llu | %d |\n", answer_ms,
                static_cast<unsigned long long>(r.frames - answers + r.lost - lost),
                static_cast<unsigned long long>(r.lost - lost), faults);
  }
}
