// Timing of ticks that a device calls (a vendor's scheduler), at a rate that is its own: time is what has passed
// between the calls. A call more than half a period after it was due is late by the whole periods in between, which
// count as missed. One thread.
#pragma once

#include "workbench/session/deadline_pacer.h"

#include <cstdint>

namespace tangent {

class CallPacer {
 public:
  /// `rate_hz`: of the calls, as the device says.
  explicit CallPacer(double rate_hz) : period_ns_(1e9 / rate_hz) {}

  /// `now_ns`: of a monotonic clock. Time goes on from earlier calls; the gap to them is not part of it.
  void start() noexcept { last_ns_ = 0; }
  TickTiming begin(std::int64_t now_ns) noexcept;

 private:
  double period_ns_;
  double t_s_ = 0.0;
  std::int64_t last_ns_ = 0;  ///< 0: none since start
};

}  // namespace tangent
