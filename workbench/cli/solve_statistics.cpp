#include "workbench/cli/solve_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tangent {

Distribution distribution(std::vector<double> values) {
  Distribution out;
  out.count = values.size();
  if (values.empty()) return out;
  std::sort(values.begin(), values.end());
  const auto rank = [&](double part) {
    const double position = std::ceil(part * static_cast<double>(values.size()));
    return values[std::clamp<std::size_t>(static_cast<std::size_t>(position), 1, values.size()) - 1];
  };
  out.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  out.p50 = rank(0.5);
  out.p99 = rank(0.99);
  out.p999 = rank(0.999);
  out.max = values.back();
  return out;
}

void SolveStatistics::reserve(std::size_t ticks) {
  iterations_.reserve(ticks);
  event_free_iterations_.reserve(ticks);
  solve_ns_.reserve(ticks);
}

void SolveStatistics::add(const TickOutput& output, double solve_ns) {
  ++statuses_[static_cast<std::size_t>(output.status)];
  ++events_[static_cast<std::size_t>(output.event)];
  iterations_.push_back(output.iterations);
  if (output.event == TickEvent::none) event_free_iterations_.push_back(output.iterations);
  solve_ns_.push_back(solve_ns);
  if (output.status != TickStatus::unconverged) max_error_m_ = std::max(max_error_m_, output.error_m);
}

}  // namespace tangent
