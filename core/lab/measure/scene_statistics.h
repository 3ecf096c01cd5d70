// Statistics of a method on a run of ticks: counts, iterations, time, and differences from another run of the same
// poses. Pure; times are measured by the caller.
#pragma once

#include "core/lab/measure/distribution.h"
#include "core/tick/step.h"

#include <array>
#include <cstdint>
#include <span>

namespace tangent {

struct RunStatistics {
  std::uint64_t ticks = 0;
  std::array<std::uint64_t, kTickStatuses.size()> statuses{};  ///< by TickStatus
  std::array<std::uint64_t, kTickEvents.size()> events{};      ///< by TickEvent
  std::uint64_t not_finite = 0;         ///< ticks with a NaN or an infinity anywhere in their output
  std::uint64_t unmarked_jumps = 0;     ///< see below
  std::uint64_t first_unconverged = 0;  ///< tick; meaningful where there is one
  double max_error_m = 0.0;             ///< of the converged ticks
  Distribution iterations;              ///< of ticks without event
  Distribution all_iterations;
  Distribution ns;  ///< of all ticks
  Distribution eventless_ns;
  Distribution seeding_ns;  ///< of ticks with event `first` or `reseed`

  std::uint64_t count(TickStatus s) const { return statuses[static_cast<std::size_t>(s)]; }
  std::uint64_t count(TickEvent e) const { return events[static_cast<std::size_t>(e)]; }
  std::uint64_t unconverged() const { return count(TickStatus::unconverged); }
};

/// `inputs`, `outputs` and `ns` tick by tick; `ns` may be empty. An unmarked jump is a tick without event whose normal
/// turned by more than 10 degrees since the last tick while the finger moved by less than `slow_m`.
RunStatistics run_statistics(std::span<const TickInput> inputs, std::span<const TickOutput> outputs,
                             std::span<const double> ns, double slow_m = 0.2e-3);

/// Difference between two outputs for the same pose.
struct OutputDifference {
  double contact_m = 0.0, normal_rad = 0.0, force_n = 0.0, display_m = 0.0;
};
OutputDifference difference(const TickOutput& a, const TickOutput& b);

struct RunDifference {
  std::uint64_t compared = 0;  ///< ticks that converged in both runs
  std::uint64_t left_out = 0;  ///< the others
  Distribution contact_m, normal_rad, force_n, display_m;
};

/// Accumulates differences tick by tick.
class RunComparison {
 public:
  void reserve(std::size_t ticks);
  void add(const TickOutput& a, const TickOutput& b);
  void leave_out() { ++left_out_; }
  RunDifference result() const;

 private:
  std::uint64_t left_out_ = 0;
  std::vector<double> contact_m_, normal_rad_, force_n_, display_m_;
};

bool all_finite(const TickOutput& output);

}  // namespace tangent
