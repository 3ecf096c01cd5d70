// The end of a tick: what the devices get from its planes. Inline: every tick ends so.
#pragma once

#include "core/tick/sources.h"
#include "core/tick/tick.h"

namespace tangent {

/// Of the finger since the last tick; nothing where there was none. `position`: world, m.
inline FingerWay finger_way(const Vec3& position, double t_s, const TickState& state) {
  if (!state.has_previous) return {};
  return {position - state.last_position, t_s > state.last_t_s ? t_s - state.last_t_s : 0.0};
}

/// World, m/s; zero where nothing asks for it (no damping).
inline Vec3 finger_velocity(const Preset& preset, const FingerWay& way) {
  if (preset.force.damping_n_s_per_m == 0.0 || !(way.dt_s > 0.0)) return Vec3(0.0);
  return way.moved / way.dt_s;
}

/// Sets force and display of `out` from the planes of the preset's sources, blended with what was `rendered` last.
/// `section`: of the finger, world; `velocity`: m/s.
inline void render_planes(const Preset& preset, const TickPlanes& planes, const FingerSection& section,
                          const FingerWay& way, const Vec3& velocity, RenderedState& rendered, TickOutput& out) {
  const Rendered decided =
      render(preset, force_plane(preset, planes), tactile_plane(preset, planes), section, velocity);
  out.decided_force_n = decided.force_n;
  out.decided_cld_m = decided.cld_m;
  const Rendered blended = blend(preset, way, decided, rendered);
  out.force_n = blended.force_n;
  out.cld_m = blended.cld_m;
}

}  // namespace tangent
