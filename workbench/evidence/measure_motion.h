// The numbers of a preset's evidence: one motion solved with one preset.
#pragma once

#include "core/io/preset_evidence.h"
#include "core/tick/step.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace tangent {

/// Solves the motion from nothing, tick by tick, and beside every converged contact of the smooth surface the solution
/// to 1e-12 of the scene's size (core/lab/measure/converged_answer.h). The same numbers on every run; `timed` adds
/// median_solve_ns. Asks `keep_going` every few hundred ticks; empty: it said no.
std::optional<EvidenceNumbers> measure_motion(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                                              std::span<const TickInput> motion, bool timed,
                                              const std::function<bool()>& keep_going);

}  // namespace tangent
