// The yardstick: one evaluation of point, normal and all first derivatives of a patch.
#pragma once

#include "core/tick/step.h"
#include "workbench/bench/tick_clock.h"

#include <span>

namespace tangent::bench {

struct EvaluationTime {
  double throughput_ns = 0.0;  ///< one of many independent evaluations: the smallest figure there is
  double latency_ns = 0.0;     ///< each waits for the one before, as in an iteration
  double alone_ns = 0.0;       ///< middle mean of many timed one by one, clock taken off, as ticks are: what ratios use
};

/// On the patches of up to 16 of the ticks' triangles (as many as a stepper keeps), at the ticks' places. Least of
/// several rounds.
EvaluationTime evaluation_time(const ContactMesh& mesh, std::span<const TickOutput> ticks, NormalForm form,
                               const TickClock& clock);

}  // namespace tangent::bench
