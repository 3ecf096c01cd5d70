// The smallest change of one parameter that cures a tick.
#pragma once

#include "core/lab/explain/tick_trials.h"

#include <functional>

namespace tangent {

/// A parameter that may cure, the side to which it is changed, and the length by which changes of it are measured.
struct CureCandidate {
  const char* key = nullptr;  ///< "solver.gain_curvature_m"
  int side = 1;               ///< +1: larger values, -1: smaller ones
  double scale = 1.0;
};

enum class CuredWhen : std::uint8_t {
  plain,      ///< nothing wants explaining any more
  converged,  ///< converged without an event, in however many planes
};

/// Tries each candidate's values ever further from the present one, then halves the way back to it. Of those that cure
/// the one with the smallest change against its scale, rounded to three digits where that still cures.
TickCure find_cure(TickTrials& trials, std::span<const CureCandidate> candidates, CuredWhen when = CuredWhen::plain);

/// The same with any way of solving with a value: `solve(value)` gives the output, `plain(output)` whether it is cured.
TickCure find_cure_of(const Preset& preset, const CureCandidate& candidate,
                      const std::function<TickOutput(double)>& solve,
                      const std::function<bool(const TickOutput&)>& plain);

}  // namespace tangent
