// Every method on one motion, as its presets have it: speed against error, in turns (turns.h).
#pragma once

#include "workbench/bench/measure.h"
#include "workbench/bench/tick_errors.h"

namespace tangent::bench {

struct CompareMethodsOptions {
  int rounds = 12;
  double most_s = 20.0;  ///< no round begins later, but for the first three
  std::uint64_t seed = 1;
  Stop stop = [] { return false; };
};

struct ComparedMethod {
  Method method = Method::robust;
  std::uint64_t ticks = 0, unconverged = 0;
  Distribution iterations;
  /// Contact of the converged ticks from the exact one: for a smooth method its own contact iterated on, else that of
  /// `robust`, both to kConvergedShare (1e-12) of the object's size.
  Distribution error_m;
  Distribution ns;          ///< of a tick, the least of its rounds
  MeanInterval typical_ns;  ///< of the rounds' middle means
  RatioInterval to_fastest;
  bool fastest = false, tie = false;  ///< of the typical tick
};

struct MethodComparison {
  std::vector<ComparedMethod> methods;  ///< in the order of kMeasuredMethods
  std::uint64_t ticks = 0;
  int rounds = 0;
  double clock_overhead_ns = 0.0;
};

/// Empty when stopped, or without ticks. Of the parts' presets every value but the method is used.
std::optional<MethodComparison> compare_methods(std::span<const MotionPart> parts, const TickClock& clock,
                                                const CompareMethodsOptions& options = {});

/// One pass over the parts as a competitor of turns. `parts`, `clock` and `stop` must outlive it.
TimedPass solving_pass(std::span<const MotionPart> parts, std::function<Preset(const Preset&)> apply,
                       const TickClock& clock, const Stop& stop);

}  // namespace tangent::bench
