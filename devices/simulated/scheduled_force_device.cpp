#include "devices/simulated/scheduled_force_device.h"

#include <cmath>
#include <ctime>
#include <system_error>

namespace tangent {

namespace {

constexpr double kRate_hz = 1000.0;

void add_ns(timespec& time, long ns) {
  time.tv_nsec += ns;
  if (time.tv_nsec < 1'000'000'000) return;
  time.tv_nsec -= 1'000'000'000;
  ++time.tv_sec;
}

}  // namespace

ScheduledForceDevice::ScheduledForceDevice(const SimulatedForceOptions& options)
    : device_(options), capabilities_(device_.capabilities()) {
  capabilities_.name = "simulated force device with a scheduler";
  capabilities_.rate_hz = kRate_hz;
}

void ScheduledForceDevice::close() {
  stop_calling();
  device_.close();
}

Status ScheduledForceDevice::start_calling(const DeviceTick& tick) {
  if (thread_.joinable()) return {};
  calling_.store(true, std::memory_order_relaxed);
  try {
    thread_ = std::thread([this, tick]() noexcept { call(tick); });
  } catch (const std::system_error&) {
    calling_.store(false, std::memory_order_relaxed);
    return fail("no thread could be started", capabilities_.name, "end other programs, or raise the limit on threads");
  }
  return {};
}

void ScheduledForceDevice::stop_calling() {
  calling_.store(false, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

void ScheduledForceDevice::call(DeviceTick tick) noexcept {
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  while (calling_.load(std::memory_order_relaxed)) {
    add_ns(due, std::lround(1e9 / kRate_hz));
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    tick.run(tick.context);
  }
}

}  // namespace tangent
