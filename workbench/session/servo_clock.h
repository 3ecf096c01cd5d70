// The servo's clock: CLOCK_MONOTONIC, or a fake one in tests.
#pragma once

#include <cstdint>

namespace tangent {

class ServoClock {
 public:
  virtual ~ServoClock() = default;
  virtual std::int64_t now_ns() noexcept = 0;
  /// Returns at or after `deadline_ns`; immediately when that has passed.
  virtual void sleep_until(std::int64_t deadline_ns) noexcept = 0;
};

class MonotonicClock final : public ServoClock {
 public:
  std::int64_t now_ns() noexcept override;
  void sleep_until(std::int64_t deadline_ns) noexcept override;  ///< clock_nanosleep, absolute
};

/// CLOCK_MONOTONIC in nanoseconds. Any thread.
std::int64_t monotonic_ns() noexcept;

}  // namespace tangent
