#include "workbench/session/servo_clock.h"

#include <cerrno>
#include <ctime>

namespace tangent {

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

}  // namespace

std::int64_t monotonic_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * kSecond + t.tv_nsec;
}

std::int64_t MonotonicClock::now_ns() noexcept { return monotonic_ns(); }

void MonotonicClock::sleep_until(std::int64_t deadline_ns) noexcept {
  timespec t{};
  t.tv_sec = static_cast<time_t>(deadline_ns / kSecond);
  t.tv_nsec = static_cast<long>(deadline_ns % kSecond);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {}
}

}  // namespace tangent
