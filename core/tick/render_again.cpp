#include "core/tick/render_again.h"

#include "core/preset/schema.h"
#include "core/shading/way_out.h"
#include "core/tick/planar_contacts.h"
#include "core/tick/rendering.h"

#include <algorithm>

namespace tangent {

bool same_contacts(const Preset& a, const Preset& b) {
  return only_smooth(a) && only_smooth(b) && same_for_solver(a, b);
}

TickOutput render_again(const ContactScene& scene, const Preset& preset, const TickInput& input, const TickState& kept,
                        RenderedState& rendered, TickOutput solved) {
  const FingerPose pose = scene.planar() ? section_pose(input.finger) : input.finger;
  TickPlanes planes = TickPlanes::all(kNoPlane);
  const bool touched = solved.status != TickStatus::free;
  planes.smooth = {solved.normal, touched ? solved.penetration_m : std::min(0.0, solved.penetration_m), 1.0};
  planes.touched = plane_of_way_out(solved.way_out_m, planes.smooth);
  const FingerWay way = finger_way(pose.position, input.t_s, kept);
  render_planes(preset, planes, section_of(pose.orientation), way, input.velocity, rendered, solved);
  return solved;
}

}  // namespace tangent
