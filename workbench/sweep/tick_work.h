// What a tick costs by what it does, counted instead of timed: the same on every machine and in every run, so that a
// search by time gives the same presets for the same seed. How well it stands for the time that a tick takes is
// measured (README.md, "Time").
#pragma once

#include "core/tick/tick.h"

namespace tangent::sweep {

/// Microseconds of a tick that gave `output`, by the prices below: fitted to the times of 320,000 ticks of spot,
/// fandisk and a torus under `paper`, `newton` and `robust`. `searched`: it asked for other places (Clearance::centre
/// moved).
double counted_us(const TickOutput& output, bool searched);

inline constexpr double kTickUs = 0.09, kPlaneUs = 0.105;  ///< any tick; each plane
inline constexpr double kCrossingUs = 0.073;               ///< each triangle that the contact walks to
inline constexpr double kSearchUs = 4.8;                   ///< other places were asked for
inline constexpr double kSeedUs = 8.3;                     ///< a start from the nearest triangles, beside its planes

}  // namespace tangent::sweep
