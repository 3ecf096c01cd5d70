#include "core/tick/tick_context.h"

#include "core/finger/plane_contact.h"

namespace tangent {

RenderPlane last_converged_plane(const TickContext& tick) {
  const TickState& state = tick.state;
  RenderPlane plane = kNoPlane;
  plane.share = kRampWasOver;
  if (!state.has_converged || state.unentered) return plane;
  const ConvergedPlane& last = state.last_converged;
  plane.normal = last.normal;
  plane.penetration_m = contact_on_plane(tick.finger, tick.local, last.point, last.normal).penetration_m;
  const auto share_at = [&](double t_s) { return unconverged_share(tick.preset.safety, t_s - state.last_converged_s); };
  plane.share = share_at(tick.t_s);
  if (plane.share == 0.0 && state.has_previous && share_at(state.last_t_s) == 0.0) plane.share = kRampWasOver;
  return plane;
}

}  // namespace tangent
