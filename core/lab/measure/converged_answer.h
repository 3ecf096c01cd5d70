// The answer that a method was on its way to: the place it stopped at, solved on to a far smaller tolerance.
#pragma once

#include "core/tick/step.h"

#include <optional>

namespace tangent {

/// Smallest tolerance that answers are compared with, as a part of the largest coordinate of mesh or finger: far
/// below any tolerance in use, above rounding: 1e-13 m on an object of 100 mm.
inline constexpr double kConvergedShare = 1e-12;

/// Tolerance of converged answers in this scene, m.
double converged_tolerance_m(const ContactScene& scene, const Finger& finger);

/// `state`: after the tick that gave `output`, converged. Solves on from its plane, without looking for other places
/// and whatever the method, to `tolerance_m`. None where that leads elsewhere: the method stopped where there is no
/// solution.
std::optional<TickOutput> converged_answer(Stepper& stepper, const Preset& preset, const TickInput& input,
                                           const TickState& state, double tolerance_m);

}  // namespace tangent
