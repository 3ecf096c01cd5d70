// Statistics of a run of ticks: counts, and percentiles of iterations, error and time.
#pragma once

#include "core/lab/measure/distribution.h"
#include "core/lab/measure/roughness.h"
#include "core/tick/step.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

class SolveStatistics {
 public:
  void reserve(std::size_t ticks);
  void add(const Preset& preset, const TickInput& input, const TickOutput& output, double solve_ns);

  std::uint64_t ticks() const { return iterations_.size(); }
  std::uint64_t count(TickStatus status) const { return statuses_[static_cast<std::size_t>(status)]; }
  std::uint64_t count(TickEvent event) const { return events_[static_cast<std::size_t>(event)]; }
  std::uint64_t searching() const { return searching_; }  ///< ticks whose search went on at the next
  double max_error_m() const { return max_error_m_; }     ///< of the converged ticks
  Distribution iterations() const { return distribution(iterations_); }
  /// Over the ticks whose event is `none`, that is, tracking only.
  Distribution event_free_iterations() const { return distribution(event_free_iterations_); }
  /// Whether any tick converged to a contact.
  bool touched() const { return count(TickStatus::face) + count(TickStatus::edge) + count(TickStatus::vertex) > 0; }
  const Roughness& roughness() const { return roughness_.result(); }
  Distribution solve_ns() const { return distribution(solve_ns_); }

 private:
  std::array<std::uint64_t, kTickStatuses.size()> statuses_{};
  std::array<std::uint64_t, kTickEvents.size()> events_{};
  std::vector<double> iterations_, event_free_iterations_, solve_ns_;
  std::uint64_t searching_ = 0;
  double max_error_m_ = 0.0;
  RoughnessCounter roughness_;
};

}  // namespace tangent
