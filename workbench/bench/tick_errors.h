// How far each tick's contact lies from the exact one, for any setting of the solver.
#pragma once

#include "core/lab/measure/distribution.h"
#include "core/tick/step.h"
#include "workbench/bench/turns.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tangent::bench {

/// Ticks that follow each other, on one scene under one preset. The first of them finds its contact from nothing.
struct MotionPart {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
  std::vector<TickInput> poses;
};

/// A tick of a motion in parts.
struct PartTick {
  std::size_t part = 0, tick = 0;  ///< tick: within the part
  bool operator==(const PartTick&) const = default;
};

/// `robust` at kConvergedShare (1e-12) of the object's size, for each part tick by tick. Empty: stopped.
using ExactRun = std::vector<std::vector<TickOutput>>;
std::optional<ExactRun> exact_run(std::span<const MotionPart> parts, const Stop& stop);

/// Of a tick, m: none where no exact contact is near, or none is found.
struct TickError {
  PartTick at;
  std::optional<double> error_m;
  bool converged = false;
  int iterations = 0;
};

/// A converged tick of a smooth method is compared with its own contact iterated on to kConvergedShare; one that did
/// not converge, and those of the other methods, with the exact run's. `apply`: makes a part's preset that of the
/// setting. Empty: stopped.
std::optional<std::vector<TickError>> tick_errors(std::span<const MotionPart> parts, const ExactRun& exact,
                                                  const std::function<Preset(const Preset&)>& apply, const Stop& stop);

struct ErrorSummary {
  std::uint64_t ticks = 0, unconverged = 0;
  std::uint64_t without_exact = 0;  ///< ticks that nothing exact was found for: in none of the figures
  Distribution iterations;
  Distribution error_m;            ///< of all ticks
  Distribution converged_error_m;  ///< of those that converged
  PartTick worst;                  ///< of the largest error_m
};
ErrorSummary summary_of(std::span<const TickError> errors);

}  // namespace tangent::bench
