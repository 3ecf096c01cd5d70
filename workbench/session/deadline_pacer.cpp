#include "workbench/session/deadline_pacer.h"

#include <algorithm>
#include <cmath>

namespace tangent {

DeadlinePacer::DeadlinePacer(double rate_hz, bool by_deadlines)
    : rate_hz_(rate_hz), period_ns_(1e9 / rate_hz), by_deadlines_(by_deadlines) {}

void DeadlinePacer::start(std::int64_t now_ns) noexcept {
  // Tick count and time continue from an earlier run; the next deadline is one period from now.
  origin_ns_ = now_ns - static_cast<std::int64_t>(std::llround(static_cast<double>(due_) * period_ns_));
  ++due_;
  last_start_ns_ = 0;
}

std::int64_t DeadlinePacer::deadline_ns() const noexcept {
  return origin_ns_ + static_cast<std::int64_t>(std::llround(static_cast<double>(due_) * period_ns_));
}

TickTiming DeadlinePacer::begin(std::int64_t now_ns) noexcept {
  TickTiming timing;
  const double behind_ns = std::max(0.0, static_cast<double>(now_ns - deadline_ns()));
  const auto missed = static_cast<std::uint64_t>(behind_ns / period_ns_);
  due_ += missed;
  timing.missed_deadlines = static_cast<std::uint32_t>(std::min<std::uint64_t>(missed, 0xffff'ffffu));
  timing.lateness_ns = behind_ns;
  if (last_start_ns_ != 0) timing.period_ns = static_cast<double>(now_ns - last_start_ns_);
  last_start_ns_ = now_ns;

  const std::uint64_t count = by_deadlines_ ? due_ : ticks_;
  const std::uint64_t step = by_deadlines_ && ticks_ > 0 ? due_ - last_due_ : 1;
  timing.t_s = static_cast<double>(count) / rate_hz_;
  timing.dt_s = static_cast<double>(step) / rate_hz_;
  last_due_ = due_;
  ++due_;
  ++ticks_;
  return timing;
}

}  // namespace tangent
