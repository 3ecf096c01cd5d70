#include "core/tick/tick_context.h"

#include "core/finger/plane_contact.h"

namespace tangent {

RenderPlane last_converged_plane(const TickContext& tick) {
  RenderPlane plane = kNoPlane;
  plane.share = 0.0;
  if (!tick.state.has_converged || tick.state.unentered) return plane;
  const ConvergedPlane& last = tick.state.last_converged;
  plane.normal = last.normal;
  plane.penetration_m = contact_on_plane(tick.finger, tick.local, last.point, last.normal).penetration_m;
  plane.share = unconverged_share(tick.preset.safety, tick.t_s - tick.state.last_converged_s);
  return plane;
}

}  // namespace tangent
