#include "workbench/session/call_pacer.h"

#include <algorithm>
#include <cmath>

namespace tangent {

TickTiming CallPacer::begin(std::int64_t now_ns) noexcept {
  constexpr double kLeast_ns = 1e3;  // two calls at the same time: still a tick, with a dt above zero
  TickTiming timing;
  double passed_ns = period_ns_;
  if (last_ns_ != 0) {
    passed_ns = std::max(kLeast_ns, static_cast<double>(now_ns - last_ns_));
    timing.period_ns = passed_ns;
    timing.lateness_ns = std::max(0.0, passed_ns - period_ns_);
    const double missed = std::floor(timing.lateness_ns / period_ns_ + 0.5);
    timing.missed_deadlines = static_cast<std::uint32_t>(std::min(missed, 4e9));
  }
  last_ns_ = now_ns;
  t_s_ += passed_ns * 1e-9;
  timing.t_s = t_s_;
  timing.dt_s = passed_ns * 1e-9;
  return timing;
}

}  // namespace tangent
