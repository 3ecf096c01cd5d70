// Times single ticks of tens to hundreds of nanoseconds; subtracts the overhead of reading the clock.
#pragma once

#include <chrono>
#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace tangent::bench {

/// The processor's time-stamp counter, fenced, where it is invariant; otherwise the system's clock. The system's clock
/// lets the timed work overlap with its reading, which makes an evaluation look a third faster.
class TickClock {
 public:
  /// Calibrates the counter against the system's clock, three times for 10 ms, and measures the overhead of two
  /// consecutive readings: the middle mean of ten thousand.
  TickClock();

  /// Nanoseconds of the system's clock, for durations of milliseconds.
  static std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }

  /// A reading for elapsed_ns(). Fenced: work before it has finished, work after it has not begun.
  std::int64_t mark() const {
#if defined(__x86_64__)
    if (counter_) {
      _mm_lfence();
      const auto count = static_cast<std::int64_t>(__rdtsc());
      _mm_lfence();
      return count;
    }
#endif
    return now();
  }

  double overhead_ns() const { return overhead_ns_; }

  /// Nanoseconds between two marks, less the overhead, not below zero.
  double elapsed_ns(std::int64_t from, std::int64_t to) const {
    const double ns = static_cast<double>(to - from) * ns_per_count_ - overhead_ns_;
    return ns > 0.0 ? ns : 0.0;
  }

 private:
  double measured_ns_per_count() const;

  bool counter_ = false;
  double ns_per_count_ = 1.0;
  double overhead_ns_ = 0.0;
};

}  // namespace tangent::bench
