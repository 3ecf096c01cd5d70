#include "core/tick/tick_context.h"

#include "core/finger/plane_contact.h"

namespace tangent {

RenderPlane last_converged_plane(const TickContext& tick) {
  RenderPlane plane;
  plane.share = 0.0;
  if (!tick.state.has_converged) return plane;
  const ConvergedPlane& last = tick.state.last_converged;
  plane.normal = last.normal;
  plane.penetration_m = contact_on_plane(tick.finger, tick.local, last.point, last.normal).penetration_m;
  plane.share = unconverged_share(tick.preset.safety, tick.t_s - tick.state.last_converged_s);
  return plane;
}

RenderPlane keep_converged_plane(const TickContext& tick, double penetration_m) {
  TickState& state = tick.state;
  state.last_converged = {state.plane.point, state.plane.normal};
  state.has_converged = 1;
  state.last_converged_s = tick.t_s;
  return {state.plane.normal, penetration_m, 1.0};
}

}  // namespace tangent
