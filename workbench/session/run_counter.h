// Sums over the ticks of a run, and the list of its changed contacts.
#pragma once

#include "workbench/session/resolve_history.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <vector>

namespace tangent {

/// Processor time of this thread.
inline std::int64_t processor_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

/// Accumulates the numbers of a run; a histogram of iterations gives percentiles without sorting.
struct RunCounter {
  RunNumbers numbers;
  double error_sum = 0.0, iteration_sum = 0.0;
  std::vector<std::uint64_t> by_iterations;

  void count(std::int32_t iterations, std::uint64_t times) {
    const auto i = static_cast<std::size_t>(std::max(0, iterations));
    if (i >= by_iterations.size()) by_iterations.resize(std::max<std::size_t>(64, i + 1));
    by_iterations[i] += times;
  }
  void add(TickStatus status, double error_m, std::int32_t iterations) {
    ++numbers.ticks;
    if (!is_converged(status)) ++numbers.unconverged;
    error_sum += error_m;
    iteration_sum += iterations;
    numbers.worst_error_m = std::max(numbers.worst_error_m, error_m);
    numbers.most_iterations = std::max(numbers.most_iterations, iterations);
    count(iterations, 1);
  }
  void add(const RunCounter& other) {
    numbers.ticks += other.numbers.ticks;
    numbers.unconverged += other.numbers.unconverged;
    error_sum += other.error_sum;
    iteration_sum += other.iteration_sum;
    numbers.worst_error_m = std::max(numbers.worst_error_m, other.numbers.worst_error_m);
    numbers.most_iterations = std::max(numbers.most_iterations, other.numbers.most_iterations);
    for (std::size_t i = 0; i < other.by_iterations.size(); ++i) {
      if (other.by_iterations[i] > 0) count(static_cast<std::int32_t>(i), other.by_iterations[i]);
    }
  }
  RunNumbers done() const {
    RunNumbers out = numbers;
    if (out.ticks == 0) return out;
    const auto n = static_cast<double>(out.ticks);
    out.mean_iterations = iteration_sum / n;
    out.mean_error_m = error_sum / n;
    const auto rank = static_cast<std::uint64_t>(std::ceil(0.99 * n));
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < by_iterations.size() && below < rank; ++i) {
      below += by_iterations[i];
      out.p99_iterations = static_cast<std::int32_t>(i);
    }
    return out;
  }
};

/// Merges the change with the last one if it is at most kJoinWithin ticks later; drops it beyond kMostChanges.
inline void append_change(std::vector<ContactChange>& changes, const ContactChange& next) {
  constexpr std::uint64_t kJoinWithin = 20;
  if (changes.empty() || next.first_tick > changes.back().last_tick + kJoinWithin) {
    if (changes.size() < ResolvedHistory::kMostChanges) changes.push_back(next);
    return;
  }
  ContactChange& into = changes.back();
  into.last_tick = next.last_tick;
  into.ticks += next.ticks;
  if (!(next.moved_m > into.moved_m)) return;
  into.worst_tick = next.worst_tick;
  into.moved_m = next.moved_m;
  into.recorded = next.recorded;
  into.resolved = next.resolved;
}

}  // namespace tangent
