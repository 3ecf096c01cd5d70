// Errors of the last ticks by iteration, each from stepping the tick again: a fan of curves behind that of the tick in
// view. Moving on by a few ticks steps only those.
#pragma once

#include "workbench/session/session.h"

#include <cstddef>
#include <cstdint>
#include <deque>
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
    std::vector<std::uint8_t> seed;  ///< of each: curves break where it changes
  };

  /// The kTicks ticks up to `tick`, those that are kept.
  void show(Session& session, std::uint64_t tick);
  void clear() { curves_.clear(); }
  /// By tick; the last is `tick` itself.
  const std::deque<Curve>& curves() const { return curves_; }
  std::size_t longest() const;  ///< iterations of the curve with the most

 private:
  void add(Session& session, const ServoRecord& record);
  std::deque<Curve> curves_;
  std::unique_ptr<IterationTrace> trace_ = std::make_unique<IterationTrace>();
};

/// Iterations that the error plot has room for. Where time stands still they are those of the tick in view: one that
/// takes two must not be squeezed by one before it that took fifty. While it runs the axis has to stand still, and
/// holds all of the fan.
std::size_t iterations_shown(std::size_t of_tick, std::size_t longest_of_fan, bool paused);

}  // namespace tangent
