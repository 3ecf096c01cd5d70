// The unit of comparison: the time of one evaluation of a patch's point, normal and all first derivatives.
#pragma once

#include "core/tick/step.h"
#include "workbench/bench/tick_clock.h"

#include <span>

namespace tangent::bench {

struct EvaluationTime {
  double throughput_ns = 0.0;  ///< per evaluation, many independent ones: the smallest figure
  double latency_ns = 0.0;     ///< each depends on the previous one, as in an iteration
  double alone_ns = 0.0;       ///< middle mean, timed one by one less the clock, as ticks are: used in ratios
};

/// Measured on the patches of up to 16 of the ticks' triangles (as many as a stepper keeps), at the ticks' places.
/// Minimum of several rounds.
EvaluationTime evaluation_time(const ContactMesh& mesh, std::span<const TickOutput> ticks, NormalForm form,
                               const TickClock& clock);

}  // namespace tangent::bench
