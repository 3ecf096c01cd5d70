// What the stages of one tick share, 3D or 2D.
#pragma once

#include "core/contact/trace.h"
#include "core/preset/preset.h"
#include "core/shading/render.h"
#include "core/tick/tick.h"

namespace tangent {

struct TickContext {
  const Preset& preset;
  const Finger& finger;  ///< the preset's; in 2D its section, a point or a circle
  double t_s = 0.0;
  FingerPose local;  ///< of the finger, in the scene's local coordinates
  Vec3 origin{0.0};  ///< world = origin + local
  TickState& state;
  IterationTrace* trace = nullptr;
};

/// The plane that an unconverged tick renders: the last converged one at the present pose, ramping to zero; share 0
/// where there is none.
RenderPlane last_converged_plane(const TickContext& tick);

/// Keeps state.plane as the last converged one, touched `penetration_m` deep, and gives it for rendering.
RenderPlane keep_converged_plane(const TickContext& tick, double penetration_m);

}  // namespace tangent
