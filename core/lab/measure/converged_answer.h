// The exact solution near a method's result: iterates on from its contact to a far smaller tolerance.
#pragma once

#include "core/tick/step.h"

#include <optional>

namespace tangent {

/// That tolerance as a fraction of the largest coordinate of mesh or finger: far below any tolerance in use, above
/// rounding; 1e-13 m on an object of 100 mm.
inline constexpr double kConvergedShare = 1e-12;

/// Tolerance of converged answers in this scene, m.
double converged_tolerance_m(const ContactScene& scene, const Finger& finger);

/// `state`: after the tick that gave `output`, which converged. Iterates from its plane to `tolerance_m`, whatever the
/// preset's method, without searching for other places. Empty where that leads to another place, that is, where the
/// method stopped without a solution nearby.
std::optional<TickOutput> converged_answer(Stepper& stepper, const Preset& preset, const TickInput& input,
                                           const TickState& state, double tolerance_m);

}  // namespace tangent
