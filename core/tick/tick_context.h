// What the stages of one tick share, 3D or 2D.
#pragma once

#include "core/contact/trace.h"
#include "core/preset/preset.h"
#include "core/shading/render.h"
#include "core/tick/tick.h"

namespace tangent {

/// By reference: what a tick has just written would be waited for if it were copied on.
struct TickContext {
  const Preset& preset;
  const Finger& finger;  ///< the preset's; in 2D its section, a point or a circle
  double t_s;
  const FingerPose& pose;   ///< of the finger, world; in 2D its section's
  const FingerPose& local;  ///< the same in the scene's local coordinates
  const Vec3& origin;       ///< world = origin + local
  TickState& state;
  IterationTrace* trace;
  const std::optional<Vec3>& velocity;  ///< of the finger, world, where the device measures it
  bool all_at_once = false;             ///< TickInput::all_at_once
};

/// The plane that an unconverged tick renders: the last converged one at the present pose, ramping to zero; share
/// kRampWasOver where that is over, or there is none.
RenderPlane last_converged_plane(const TickContext& tick);

/// Keeps state.plane as the last converged one, touched `penetration_m` deep, and gives it for rendering in `plane`.
inline void keep_converged_plane(const TickContext& tick, double penetration_m, RenderPlane& plane) {
  TickState& state = tick.state;
  state.last_converged = {state.plane.point, state.plane.normal};
  state.has_converged = 1;
  state.last_converged_s = tick.t_s;
  plane.normal = state.plane.normal;
  plane.penetration_m = penetration_m;
  plane.share = 1.0;
}

}  // namespace tangent
