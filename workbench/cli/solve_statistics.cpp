#include "workbench/cli/solve_statistics.h"

#include <algorithm>

namespace tangent {

void SolveStatistics::reserve(std::size_t ticks) {
  iterations_.reserve(ticks);
  event_free_iterations_.reserve(ticks);
  solve_ns_.reserve(ticks);
}

void SolveStatistics::add(const Preset& preset, const TickInput& input, const TickOutput& output, double solve_ns) {
  roughness_.add(preset, input, output);
  ++statuses_[static_cast<std::size_t>(output.status)];
  ++events_[static_cast<std::size_t>(output.event)];
  searching_ += output.searching;
  iterations_.push_back(output.iterations);
  if (output.event == TickEvent::none) event_free_iterations_.push_back(output.iterations);
  solve_ns_.push_back(solve_ns);
  if (is_converged(output.status)) max_error_m_ = std::max(max_error_m_, output.error_m);
}

}  // namespace tangent
