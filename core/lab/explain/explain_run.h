// Why a tick found no contact where the ticks before it had lost it already. What its own iteration met is no cause:
// the finger went on, and is deep where no plane is near. The first of the run is explained, and the cure is one that
// keeps the contact from there on.
#pragma once

#include "core/lab/explain/explain_tick.h"

#include <span>

namespace tangent {

/// Ticks that follow each other under one preset, none of which found a contact.
struct LostRun {
  const TickState& before;            ///< as the first was given it
  std::span<const TickInput> inputs;  ///< not empty; the last is of the tick to explain
};

/// Whether the tick before the state found no contact: what follows belongs to a run.
bool was_lost(const TickState& before);

/// Cause, number and place are those of the first; the tick is the last, and the cure the smallest change of one
/// parameter under which every tick of the run converges and the last is plain, all solved again from the first on:
/// first what cures the first, then the gains, at last `robust`. Of a run of one tick it is explain_tick.
TickExplanation explain_run(const std::shared_ptr<const ContactScene>& scene, const Preset& preset, const LostRun& run,
                            const ExplainOptions& options = {});

}  // namespace tangent
