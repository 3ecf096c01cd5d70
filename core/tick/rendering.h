// The end of a tick: what the devices get from its planes. Inline: every tick ends so.
#pragma once

#include "core/base/tolerances.h"
#include "core/shading/ramp.h"
#include "core/tick/sources.h"
#include "core/tick/tick.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

/// Of the finger since the last tick; nothing where there was none. `position`: world, m.
inline FingerWay finger_way(const Vec3& position, double t_s, const TickState& state) {
  if (!state.has_previous) return {};
  return {position - state.last_position, t_s > state.last_t_s ? t_s - state.last_t_s : 0.0,
          state.has_previous == kPoseIsOlder};
}

/// World, m/s: the device's own where it has `measured` one, else of the positions by a first-order filter of the
/// preset's cut-off f. That lags by 1/(2 pi f), and however near two stamps are, it changes by no more than 2 pi f
/// times the way between them: 9.4 mm/s at 50 Hz for an encoder's step of 0.03 mm, at any rate of ticks. Zero where
/// nothing asks for it (no damping). Updates the one of `rendered`.
inline Vec3 finger_velocity(const Preset& preset, const FingerWay& way, const std::optional<Vec3>& measured,
                            RenderedState& rendered) {
  if (preset.force.damping_n_s_per_m == 0.0) return Vec3(0.0);
  if (measured && is_finite(*measured)) return rendered.velocity = *measured;
  if (way.over_gap) return rendered.velocity;  // how long its way took is not known any more
  const double rate = 2.0 * std::numbers::pi * preset.force.velocity_cutoff_hz;
  const double lag = 1.0 / (1.0 + rate * way.dt_s);
  rendered.velocity = lag * (rendered.velocity + rate * way.moved);  // v += (1 - lag) (moved/dt - v)
  return rendered.velocity;
}

/// Sets force and display of `out` from the planes of the preset's sources, blended with what was `rendered` last.
/// `section`: of the finger, world; `measured`: its velocity by the device, if any.
inline void render_planes(const Preset& preset, const TickPlanes& planes, const FingerSection& section,
                          const FingerWay& way, const std::optional<Vec3>& measured, RenderedState& rendered,
                          TickOutput& out) {
  const Vec3 velocity = finger_velocity(preset, way, measured, rendered);
  const RenderPlane& force = force_plane(preset, planes);
  const RenderPlane* const tactile = tactile_plane(preset, planes);
  Rendered decided = render(preset, force, tactile, section, velocity);
  out.decided_force_n = decided.force_n;
  out.decided_cld_m = decided.cld_m;
  if (out.status == TickStatus::facing) decided.ramps_out = false;  // no failure: held to the rate like every decision
  if (decided.ramps_out) {
    const bool display_ramps = tactile == nullptr || tactile->share < 1.0;
    ramp_what_was_rendered(preset, way, force.share, display_ramps, rendered, decided);
  }
  const bool switched = out.event != TickEvent::none && out.event != TickEvent::first;
  if (decided.off_pad && !decided.ramps_out && rendered.has && holds_off_pad(preset))
    out.decided_cld_m = rendered.cld_m;  // its place says nothing: to stay is what is decided
  const Rendered blended = blend(preset, way, decided, switched, rendered);
  out.force_n = blended.force_n;
  out.cld_m = blended.cld_m;
}

}  // namespace tangent
