// Times of single ticks, tens to hundreds of nanoseconds long, with what reading the clock costs taken off.
#pragma once

#include <chrono>
#include <cstdint>

namespace tangent::bench {

class TickClock {
 public:
  static std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  /// Measures what two readings with nothing between them give: the median of ten thousand.
  TickClock();
  double overhead_ns() const { return overhead_ns_; }

  /// Between two readings, less the overhead, not below zero.
  double elapsed_ns(std::int64_t from, std::int64_t to) const {
    const double ns = static_cast<double>(to - from) - overhead_ns_;
    return ns > 0.0 ? ns : 0.0;
  }

 private:
  double overhead_ns_ = 0.0;
};

}  // namespace tangent::bench
