#include "core/tick/rendering.h"

namespace tangent {

Vec3 finger_velocity(const Preset& preset, const Vec3& position, double t_s, const TickState& state) {
  const double dt = t_s - state.last_t_s;
  if (preset.force.damping_n_s_per_m == 0.0 || !state.has_previous || !(dt > 0.0)) return Vec3(0.0);
  return (position - state.last_position) / dt;
}

void render_planes(const Preset& preset, const TickPlanes& planes, const FingerPose& pose, const Vec3& velocity,
                   TickOutput& out) {
  const Rendered rendered = render(preset, force_plane(preset, planes), tactile_plane(preset, planes),
                                   section_of(pose.orientation), velocity);
  out.force_n = rendered.force_n;
  out.cld_m = rendered.cld_m;
}

}  // namespace tangent
