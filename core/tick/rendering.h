// The end of a tick: what the devices get from its planes.
#pragma once

#include "core/tick/sources.h"
#include "core/tick/tick.h"

namespace tangent {

/// Of the finger since the last tick, world, m/s; zero where nothing asks for it (no damping) or there was no last
/// tick.
Vec3 finger_velocity(const Preset& preset, const Vec3& position, double t_s, const TickState& state);

/// Sets force and display of `out` from the planes of the preset's sources. `pose`: of the finger, world; `velocity`:
/// of it, world, m/s.
void render_planes(const Preset& preset, const TickPlanes& planes, const FingerPose& pose, const Vec3& velocity,
                   TickOutput& out);

}  // namespace tangent
