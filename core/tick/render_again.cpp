#include "core/tick/render_again.h"

#include "core/tick/planar_step.h"
#include "core/tick/render.h"

namespace tangent {
namespace {

/// What the smooth methods read of a preset, everything else at its default.
SolverSettings read_by_solver(SolverSettings settings) {
  if (settings.method == Method::paper) return settings;
  const SolverSettings unread;
  settings.gain_overall = unread.gain_overall;
  settings.gain_curvature_m = unread.gain_curvature_m;
  settings.gain_distance_per_m = unread.gain_distance_per_m;
  settings.distance_reading = unread.distance_reading;
  return settings;
}

}  // namespace

bool same_contacts(const Preset& a, const Preset& b) {
  return only_smooth(a) && only_smooth(b) && a.finger == b.finger &&
         read_by_solver(a.solver) == read_by_solver(b.solver);
}

TickOutput render_again(const ContactScene& scene, const Preset& preset, const TickInput& input, const TickState& kept,
                        TickOutput solved) {
  solved.force_n = Vec3(0.0);
  solved.cld_m = 0.0;
  const FingerPose pose = scene.planar() ? section_pose(input.finger) : input.finger;
  const Vec3 velocity = finger_velocity(preset, pose.position, input.t_s, kept);
  const Rendered rendered =
      render(preset, RenderPlane{solved.normal, solved.penetration_m, 1.0}, section_of(pose.orientation), velocity);
  solved.force_n = rendered.force_n;
  solved.cld_m = rendered.cld_m;
  return solved;
}

}  // namespace tangent
