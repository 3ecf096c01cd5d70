// The end of a tick: what the devices get from its planes. Inline: every tick ends so.
#pragma once

#include "core/tick/sources.h"
#include "core/tick/tick.h"

namespace tangent {

/// Of the finger since the last tick, world, m/s; zero where nothing asks for it (no damping) or there was no last
/// tick.
inline Vec3 finger_velocity(const Preset& preset, const Vec3& position, double t_s, const TickState& state) {
  if (preset.force.damping_n_s_per_m == 0.0) return Vec3(0.0);
  const double dt = t_s - state.last_t_s;
  if (!state.has_previous || !(dt > 0.0)) return Vec3(0.0);
  return (position - state.last_position) / dt;
}

/// Sets force and display of `out` from the planes of the preset's sources. `section` and `velocity`: of the finger,
/// world, m/s.
inline void render_planes(const Preset& preset, const TickPlanes& planes, const FingerSection& section,
                          const Vec3& velocity, TickOutput& out) {
  const Rendered rendered =
      render(preset, force_plane(preset, planes), tactile_plane(preset, planes), section, velocity);
  out.force_n = rendered.force_n;
  out.cld_m = rendered.cld_m;
}

}  // namespace tangent
