// Every method on one motion: speed against error. What runs in turns meets the same machine: a round solves the motion
// once by each method, the next begins with another one, and ratios are of times of one round.
#pragma once

#include "core/lab/measure/interval.h"
#include "core/lab/measure/scene_statistics.h"
#include "workbench/bench/measure.h"

namespace tangent::bench {

/// Ticks that follow each other, on one scene under one preset. The first of them finds its contact from nothing.
struct MotionPart {
  ScenePtr scene;
  Preset preset;  ///< of which every value but the method is used
  std::vector<TickInput> poses;
};

struct CompareMethodsOptions {
  int rounds = 12;
  double most_s = 20.0;  ///< no round begins later, but for the first three
  Stop stop = [] { return false; };
};

/// A method is called a tie where it takes less than this over the fastest, or may, within the interval.
inline constexpr double kTieRatio = 1.03;

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

/// Empty when stopped, or without ticks.
std::optional<MethodComparison> compare_methods(std::span<const MotionPart> parts, const TickClock& clock,
                                                const CompareMethodsOptions& options = {});

}  // namespace tangent::bench
