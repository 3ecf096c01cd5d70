#include "workbench/bench/tick_clock.h"

#include "core/tuning/distribution.h"

namespace tangent::bench {

TickClock::TickClock() {
  constexpr int kReadings = 10'000;
  std::vector<double> spans;
  spans.reserve(kReadings);
  for (int i = 0; i < kReadings; ++i) {
    const std::int64_t from = now(), to = now();
    spans.push_back(static_cast<double>(to - from));
  }
  overhead_ns_ = distribution(std::move(spans)).p50;
}

}  // namespace tangent::bench
