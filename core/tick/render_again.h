// A tick rendered again under other values of force, display or safety, without solving for its contact again: most of
// what a person tunes is nothing that the solver reads.
#pragma once

#include "core/tick/step.h"

namespace tangent {

/// Whether two presets lead from the same state and input to the same contact and the same next state, bit for bit:
/// they differ only in what the solver does not read. Gains are read by `paper` alone. False where either asks for
/// contacts on the raw mesh.
bool same_contacts(const Preset& a, const Preset& b);

/// The output of a tick whose contact is known: `solved` is its output under a preset with the same contacts, `kept`
/// the state before it, `rendered` what `preset` rendered in the tick before; updated. The bits that Stepper::step
/// gives. Precondition: it converged.
TickOutput render_again(const ContactScene& scene, const Preset& preset, const TickInput& input, const TickState& kept,
                        RenderedState& rendered, TickOutput solved);

}  // namespace tangent
