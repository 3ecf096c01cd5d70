// When the servo's ticks are due: absolute deadlines, a whole number of periods from the start, so that no error
// adds up. A deadline that passed before the tick before it was done is skipped and counted: catching up by a burst
// would make every later tick late as well.
#pragma once

#include <cstdint>

namespace tangent {

/// What a tick knows about its time.
struct TickTiming {
  double t_s = 0.0;                    ///< of the tick, for solver and devices
  double dt_s = 1e-3;                  ///< since the tick before, > 0
  std::uint32_t missed_deadlines = 0;  ///< skipped just before
  double period_ns = 0.0;              ///< start to start; 0 for the first
  double lateness_ns = 0.0;            ///< start after the deadline waited for, skipped ones included
};

class DeadlinePacer {
 public:
  /// `by_deadlines`: t_s and dt_s follow the deadlines; otherwise they count ticks (ServoOptions).
  DeadlinePacer(double rate_hz, bool by_deadlines);

  void start(std::int64_t now_ns) noexcept;
  /// The deadline to sleep until.
  std::int64_t deadline_ns() const noexcept;
  /// The tick that begins now, at or after its deadline. Moves on to the next deadline.
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
