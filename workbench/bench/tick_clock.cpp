#include "workbench/bench/tick_clock.h"

#include "core/lab/measure/distribution.h"

#include <algorithm>
#include <array>
#include <vector>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace tangent::bench {
namespace {

/// Whether the processor reports an invariant time-stamp counter.
bool has_steady_counter() {
#if defined(__x86_64__)
  constexpr unsigned kPowerManagement = 0x80000007, kInvariant = 1u << 8;
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(kPowerManagement, &a, &b, &c, &d) != 0 && (d & kInvariant) != 0;
#else
  return false;
#endif
}

}  // namespace

TickClock::TickClock() : counter_(has_steady_counter()) {
  constexpr int kReadings = 10'000;
  if (counter_) {
    std::array<double, 3> rates;  // one may be wrong if the thread is interrupted between two readings
    for (double& rate : rates) rate = measured_ns_per_count();
    std::sort(rates.begin(), rates.end());
    ns_per_count_ = rates[1];
  }
  std::vector<double> spans;
  spans.reserve(kReadings);
  for (int i = 0; i < kReadings; ++i) {
    const std::int64_t from = mark(), to = mark();
    spans.push_back(static_cast<double>(to - from) * ns_per_count_);
  }
  overhead_ns_ = middle_mean(std::move(spans));
}

double TickClock::measured_ns_per_count() const {
  constexpr std::int64_t kLongNs = 10'000'000;
  const std::int64_t began = now(), first = mark();
  std::int64_t ended = began;
  while (ended - began < kLongNs) ended = now();
  return static_cast<double>(ended - began) / static_cast<double>(mark() - first);
}

}  // namespace tangent::bench
