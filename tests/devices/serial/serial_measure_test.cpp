// Real time over a pseudo-terminal, for devices/README.md: firmware and servo each by a clock of their own.
#include "tests/devices/serial/serial_bench.h"

#include <cstdio>
#include <ctime>

using namespace tangent;
using namespace tangent::serial_test;

namespace {

void wait_for_next_ms(timespec& due) {
  due.tv_nsec += 1'000'000;
  if (due.tv_nsec >= 1'000'000'000) {
    due.tv_nsec -= 1'000'000'000;
    ++due.tv_sec;
  }
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
}

/// The firmware, every millisecond.
class FirmwareClock {
 public:
  explicit FirmwareClock(SerialRig& rig)
      : thread_([this, &rig] {
          timespec due{};
          clock_gettime(CLOCK_MONOTONIC, &due);
          while (!done_) {
            wait_for_next_ms(due);
            while (rig.listen()) {}
            rig.step();
          }
        }) {}
  ~FirmwareClock() {
    done_ = true;
    thread_.join();
  }
  FirmwareClock(const FirmwareClock&) = delete;
  FirmwareClock& operator=(const FirmwareClock&) = delete;

 private:
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace

TEST_CASE("measure: 10,000 ticks through serial" * doctest::skip()) {
  DevFolder dev;
  SerialRig rig;
  rig.plug_in(dev);
  SerialForceOptions options;
  options.dev = dev.path();
  SerialForceDevice device(options);
  const FirmwareClock firmware(rig);
  REQUIRE(device.open());
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  const auto tick = [&](const ForceCommand& command) {
    wait_for_next_ms(due);
    return device.exchange(command, 1e-3);
  };
  while (tick({}).state != DeviceState::firmware) {}
  tick({.request = DeviceRequest::home});
  while (tick({}).state != DeviceState::ready) {}
  LinkReport before;
  device.report(before);
  constexpr int kTicks = 10'000;
  const double processor_s = device.line_processor_s();
  const std::int64_t began_ns = serial_now_ns();
  int faulted = 0, withheld = 0;
  double oldest_s = 0.0, sum_s = 0.0;
  for (int i = 0; i < kTicks; ++i) {
    const ForceSample sample = tick({.force_n = {0.0, 0.0, 1.0}});
    faulted += sample.state == DeviceState::ready ? 0 : 1;
    withheld += sample.force_n == Vec3(0.0) ? 1 : 0;
    oldest_s = std::max(oldest_s, sample.age_s);
    sum_s += sample.age_s;
  }
  const double wall_s = 1e-9 * static_cast<double>(serial_now_ns() - began_ns);
  const double share = (device.line_processor_s() - processor_s) / wall_s;
  LinkReport after;
  device.report(after);
  std::printf(
      "%d ticks in %.3f s: %llu frames from the firmware, %llu lost, %llu late, %llu with a wrong CRC; %llu commands "
      "lost; %d ticks not ready, %d without force; age of the sample %.2f ms on average, %.2f ms at most; the line's "
      "thread %.2f %% of a core\n",
      kTicks, wall_s, static_cast<unsigned long long>(after.frames - before.frames),
      static_cast<unsigned long long>(after.lost - before.lost),
      static_cast<unsigned long long>(after.late - before.late),
      static_cast<unsigned long long>(after.crc_errors - before.crc_errors),
      static_cast<unsigned long long>(after.lost_by_device - before.lost_by_device), faulted, withheld,
      1e3 * sum_s / kTicks, 1e3 * oldest_s, 100.0 * share);
}
