#include "core/tick/render_again.h"

#include "core/tick/planar_contacts.h"
#include "core/tick/rendering.h"

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
                        RenderedState& rendered, TickOutput solved) {
  const FingerPose pose = scene.planar() ? section_pose(input.finger) : input.finger;
  TickPlanes planes = TickPlanes::all(kNoPlane);
  planes.smooth = {solved.normal, solved.penetration_m, 1.0};
  const FingerWay way = finger_way(pose.position, input.t_s, kept);
  render_planes(preset, planes, section_of(pose.orientation), way, finger_velocity(preset, way), rendered, solved);
  return solved;
}

}  // namespace tangent
