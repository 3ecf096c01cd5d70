// Schedules the servo's ticks by absolute deadlines at whole periods from the start, so that errors don't accumulate. A
// deadline that has passed before the previous tick was done is skipped and counted: catching up in a burst would delay
// every later tick too. One thread.
#pragma once

#include <cstdint>

namespace tangent {

/// Timing of one tick.
struct TickTiming {
  double t_s = 0.0;                    ///< time of the tick, for solver and devices
  double dt_s = 1e-3;                  ///< since the previous tick, > 0
  std::uint32_t missed_deadlines = 0;  ///< skipped right before this tick
  double period_ns = 0.0;              ///< start to start; 0 for the first tick
  double lateness_ns = 0.0;            ///< start minus the deadline waited for; includes skipped periods
};

class DeadlinePacer {
 public:
  /// `by_deadlines`: t_s and dt_s follow the deadlines; otherwise t_s is tick / rate (ServoOptions).
  DeadlinePacer(double rate_hz, bool by_deadlines);

  /// `now_ns`: of a monotonic clock, here and in begin. The first deadline is one period later.
  void start(std::int64_t now_ns) noexcept;
  /// The deadline to sleep until, on the clock given to start.
  std::int64_t deadline_ns() const noexcept;
  /// Timing of the tick that begins now, at or after its deadline. Advances to the next deadline.
  TickTiming begin(std::int64_t now_ns) noexcept;

 private:
  double rate_hz_, period_ns_;
  bool by_deadlines_;
  std::int64_t origin_ns_ = 0;
  std::uint64_t due_ = 0;  ///< periods from the origin to the next deadline
  std::uint64_t ticks_ = 0;
  std::uint64_t last_due_ = 0;
  std::int64_t last_start_ns_ = 0;
};

}  // namespace tangent
