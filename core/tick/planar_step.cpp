#include "core/tick/planar_step.h"

#include "core/planar/polygon_contact.h"
#include "core/planar/track.h"
#include "core/tick/render.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

/// A proxy this far from the finger, in sizes of the polygon, is given up.
constexpr double kLeapShare = 0.25;

Vec3 lifted(const Vec2& v) { return {v.x, v.y, 0.0}; }
Vec2 flat(const Vec3& v) { return {v.x, v.y}; }

PlanarPlace place_of(const TrackedPlane& plane) {
  return {plane.feature, plane.triangle, plane.u, flat(plane.point), flat(plane.normal)};
}

TrackedPlane plane_of(const PlanarPlace& place) {
  TrackedPlane plane;
  plane.feature = place.feature;
  plane.side = place.t > 0.5 ? 1 : 0;
  plane.triangle = place.patch;
  plane.u = place.t;
  plane.point = lifted(place.point);
  plane.normal = lifted(place.normal);
  return plane;
}

/// The plane that an unconverged tick renders: the last converged one at the present pose, ramping to zero.
RenderPlane last_converged_plane(const Preset& preset, const TickState& state, const Vec2& centre, double radius,
                                 double t_s) {
  RenderPlane plane;
  plane.share = 0.0;
  if (!state.has_converged) return plane;
  plane.normal = state.last_converged.normal;
  plane.penetration_m = radius - glm::dot(lifted(centre) - state.last_converged.point, plane.normal);
  plane.share = unconverged_share(preset.safety, t_s - state.last_converged_s);
  return plane;
}

RenderPlane track_smooth(const PlanarContext& context, const Preset& preset, double t_s, TickState& state,
                         PlanarTrack& track) {
  // A state kept on another scene names patches that this one may not have.
  const bool ours = state.plane.triangle < context.curve.patch_count();
  track = track_planar(context, ours ? place_of(state.plane) : PlanarPlace{});
  state.plane = plane_of(track.contact.place);
  if (!track.converged()) return last_converged_plane(preset, state, context.centre, context.radius_m, t_s);
  state.last_converged = {state.plane.point, state.plane.normal};
  state.has_converged = 1;
  state.last_converged_s = t_s;
  return {state.plane.normal, context.radius_m - track.contact.height_m, 1.0};
}

void describe_smooth(const PlanarTrack& track, double radius, const Vec3& origin, TickOutput& out) {
  const PlanarContact& c = track.contact;
  out.penetration_m = radius - c.height_m;
  out.status = track.converged() ? status_of(c.place.feature, out.penetration_m) : TickStatus::unconverged;
  out.triangle = c.place.patch;
  out.u = c.place.t;
  out.contact = origin + lifted(c.place.point);
  out.normal = lifted(c.place.normal);
  out.error_m = c.error_m;
  out.event = track.event;
  out.iterations = track.evaluations;
  out.triangle_changes = track.patch_changes;
}

}  // namespace

FingerPose section_pose(const FingerPose& pose) {
  const Vec3 x = pose.orientation * Vec3(1.0, 0.0, 0.0);
  const double turn = std::atan2(x.y, x.x);
  const Quat about_z(std::cos(0.5 * turn), 0.0, 0.0, std::sin(0.5 * turn));
  // Finger z to the plane's y: a quarter turn back about x.
  const Quat lay_down(std::numbers::sqrt2 / 2.0, -std::numbers::sqrt2 / 2.0, 0.0, 0.0);
  return {{pose.position.x, pose.position.y, 0.0}, about_z * lay_down};
}

TickOutput step_planar(const PlanarCurve& curve, const Preset& preset, const TickInput& input, TickState& state,
                       IterationTrace* trace) {
  TickOutput out;
  out.normal = Vec3(0.0, 1.0, 0.0);
  TickContacts contacts;
  const double radius = preset.finger.shape == FingerShape::point ? 0.0 : preset.finger.radius_m;
  const Vec3 origin = lifted(curve.origin());
  if (!is_finite(input.finger.position) ||
      !std::isfinite(glm::dot(input.finger.orientation, input.finger.orientation))) {
    const FingerPose last = section_pose({state.last_position, Quat(1.0, 0.0, 0.0, 0.0)});
    contacts.smooth_plane = last_converged_plane(preset, state, flat(last.position - origin), radius, input.t_s);
    contacts.facet_plane = contacts.shaded_plane = contacts.proxy_force = contacts.proxy_place = contacts.smooth_plane;
    render(preset, contacts, last, Vec3(0.0), out);
    return out;
  }
  const FingerPose pose = section_pose(input.finger);
  const Vec3 centre = pose.position - origin;
  const PolygonSurface surface(curve, preset.solver.tolerance_m);
  const Method method = preset.solver.method;
  if (wants_smooth(preset)) {
    SolverSettings settings = preset.solver;
    if (!is_smooth(method)) settings.method = Method::robust;
    PlanarTrack track;
    contacts.smooth_plane =
        track_smooth({curve, settings, flat(centre), radius, trace, 0}, preset, input.t_s, state, track);
    if (is_smooth(method)) describe_smooth(track, radius, origin, out);
  }
  if (wants_facet(preset)) {
    const FacetContact facet = surface.nearest(centre);
    const double depth = radius - facet.height_m;
    contacts.facet_plane = {facet.normal, depth, 1.0};
    contacts.shaded_plane = {surface.interpolated_normal(facet), depth, 1.0};
    if (method == Method::facet) describe_facet(facet, contacts.facet_plane, origin, out);
    if (method == Method::force_shading) describe_facet(facet, contacts.shaded_plane, origin, out);
  }
  if (method == Method::two_pass)
    step_two_pass(surface, preset, centre, origin, kLeapShare * curve.size_m(), state, contacts, out);

  render(preset, contacts, pose, finger_velocity(preset, pose.position, input.t_s, state), out);
  keep_pose(pose.position, input.t_s, state);
  return out;
}

PolygonMesh ribbon(const PlanarCurve& curve, double half_width_m) {
  const PolygonSurface surface(curve, 0.0);
  PolygonMesh mesh;
  mesh.name = curve.polygon().name;
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    if (curve.patch(i).joint_after != CurveJoint::smooth) continue;
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 a = lifted(curve.origin() + curve.vertex(i)), b = lifted(curve.origin() + curve.vertex(curve.after(i)));
    const Vec3 up(0.0, 0.0, half_width_m);
    for (const Vec3& p : {a - up, b - up, b + up, a + up}) mesh.positions.push_back(p);
    const Vec3 na = lifted(surface.vertex_normal(i, false)), nb = lifted(surface.vertex_normal(i, true));
    for (const Vec3& n : {na, nb, nb, na}) mesh.normals.push_back(n);
    // Counter-clockwise as seen from the finger's side.
    if (curve.side() > 0.0)
      mesh.add_face({base + 3, base + 2, base + 1, base});
    else
      mesh.add_face({base, base + 1, base + 2, base + 3});
  }
  mesh.corner_normal = mesh.corner_position;
  return mesh;
}

}  // namespace tangent
