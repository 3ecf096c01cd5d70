// Error curves (error by iteration) of the last ticks, from stepping each tick again: drawn behind the curve of the
// tick in view. Advancing by a few ticks steps only those.
#pragma once

#include "workbench/gui/model/recorded_past.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace tangent {

class ErrorFan {
 public:
  static constexpr std::size_t kTicks = 60;

  struct Curve {
    std::uint64_t tick = 0;
    std::vector<float> error_m;      ///< by iteration, [0] the kept plane
    std::vector<std::uint8_t> seed;  ///< of each iteration: curves break where it changes
  };

  /// Computes the curves of up to kTicks ticks of past.shown() ending at `tick`.
  /// `solve`: a record again, with its planes into the trace; empty where it can't be.
  using Solve = std::function<Result<TickOutput>(const ServoRecord& record, IterationTrace& trace)>;
  void show(const RecordedPast& past, std::uint64_t tick, const Solve& solve);
  void clear() { curves_.clear(); }
  /// In order; the last is that of `tick` itself.
  const std::deque<Curve>& curves() const { return curves_; }
  std::size_t longest() const;  ///< iterations of the longest curve

 private:
  void add(const ServoRecord& record, const Solve& solve);
  std::deque<Curve> curves_;
  std::unique_ptr<IterationTrace> trace_ = std::make_unique<IterationTrace>();
};

/// Length of the error plot's iteration axis. Paused: that of the tick in view, so that a tick with two iterations is
/// not compressed by an earlier one with fifty. Running: the longest of all curves, so that the axis does not jump.
std::size_t iterations_shown(std::size_t of_tick, std::size_t longest_of_fan, bool paused);

}  // namespace tangent
