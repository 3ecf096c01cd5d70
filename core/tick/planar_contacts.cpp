#include "core/tick/planar_contacts.h"

#include "core/contact/decide/decide.h"
#include "core/finger/plane_contact.h"
#include "core/planar/polygon_contact.h"
#include "core/planar/track.h"
#include "core/shading/way_out.h"
#include "core/tick/planar_way_out.h"
#include "core/tick/raw_contacts.h"
#include "core/tick/rendering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

/// A proxy this far from the finger, in sizes of the polygon, is given up.
constexpr double kLeapShare = 0.25;

Vec2 flat(const Vec3& v) { return {v.x, v.y}; }
double radius_m(const TickContext& tick) { return round_radius_m(tick.finger); }

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

PlanarKept kept_of(const PlanarCurve& curve, const TickContext& tick) {
  const TickState& state = tick.state;
  // A state kept on another scene names patches that this one may not have.
  if (state.plane.triangle >= curve.patch_count()) return {};
  PlanarKept kept{place_of(state.plane), 0.0, state.unentered != 0};
  if (state.has_converged && !state.unentered)
    kept.depth_m = contact_on_plane(tick.finger, tick.local, state.last_converged.point, state.last_converged.normal)
                       .penetration_m;
  return kept;
}

/// Keeps what was found for the next tick, and gives it for rendering.
RenderPlane kept_plane(const TickContext& tick, const PlanarTrack& track) {
  tick.state.plane = plane_of(track.contact.place);
  tick.state.unentered = track.unentered;
  RenderPlane plane;
  const double depth = radius_m(tick) - track.contact.height_m;
  keep_converged_plane(tick, track.unentered ? std::min(0.0, depth) : depth, plane);
  return plane;
}

/// `way_out`: of all places that are touched, where the preset asks for them and there are several; else zero.
void find_smooth(const PlanarCurve& curve, const TickContext& tick, const SolverSettings& settings, PlanarTrack& track,
                 TickPlanes& planes, Vec3& way_out) {
  const PlanarContext context{curve,
                              settings,
                              flat(tick.local.position),
                              radius_m(tick),
                              tick.trace,
                              0,
                              glm::length(finger_way(tick.pose.position, tick.t_s, tick.state).moved)};
  const bool all = wants_touched(tick.preset);
  track = track_planar(context, kept_of(curve, tick), all);
  PlanarWayOut out;
  if (all && track.converged()) out = find_planar_way_out(context, track, tick.state);
  tick.state.touched = out.places;
  way_out = out.way_out_m;
  track.evaluations += out.evaluations;
  if (out.leapt && track.event == TickEvent::none) track.event = TickEvent::switched;  // another set of places pushes
  if (track.converged()) {
    planes.smooth = kept_plane(tick, track);
  } else {
    tick.state.plane = plane_of(track.contact.place);
    planes.smooth = last_converged_plane(tick);
  }
  planes.touched = plane_of_way_out(way_out, planes.smooth);
}

void describe_smooth(const PlanarTrack& track, const TickContext& tick, TickOutput& out) {
  const PlanarContact& c = track.contact;
  out.penetration_m = radius_m(tick) - c.height_m;
  out.status = track.converged() ? status_of(c.place.feature, out.penetration_m) : TickStatus::unconverged;
  if (track.converged() && track.unentered) out.status = TickStatus::free;
  out.triangle = c.place.patch;
  out.u = c.place.t;
  out.contact = tick.origin + lifted(c.place.point);
  out.normal = lifted(c.place.normal);
  out.error_m = c.error_m;
  out.event = track.event;
  out.iterations = track.evaluations;
  out.triangle_changes = track.patch_changes;
}

/// Where on the curve's patches the place is drawn.
PlanarPlace place_near(const PlanarCurve& curve, const PolygonSurface& surface, const ExactContact& contact) {
  const NearestHit hit = surface.nearest(lifted(contact.point)).hit;
  const std::uint32_t patch = hit.u < 0.5 ? hit.triangle : curve.after(hit.triangle);
  const double t = curve.parameter(patch, LocalCentre::bisectors, contact.point);
  return {contact.feature, patch, std::clamp(t, 0.0, 1.0), contact.point, contact.normal};
}

/// The one line of an exact arc's tick.
void record_exact(const PlanarPlace& place, double distance_m, const TickContext& tick) {
  if (tick.trace == nullptr) return;
  IterationRecord r;
  r.feature = place.feature;
  r.stop = StopReason::converged;
  r.triangle = place.patch;
  r.u = place.t;
  r.point = r.contact = tick.origin + lifted(place.point);
  r.normal = lifted(place.normal);
  r.distance_m = distance_m;
  tick.trace->push(r);
}

/// The contact with an exact arc, by its formula. An arc has one face and no other contact: all sources of force and
/// display render it alike.
PlanarTrack find_exact(const PlanarCurve& curve, const TickContext& tick, const PolygonSurface& surface) {
  const PlanarKept kept = kept_of(curve, tick);
  ExactArc arc = *curve.polygon().exact;
  arc.centre -= curve.origin();
  const ExactContact contact = exact_contact(arc, flat(tick.local.position));
  PlanarTrack track;
  track.contact.place = place_near(curve, surface, contact);
  track.contact.height_m = contact.height_m;
  track.contact.stop = StopReason::converged;
  track.evaluations = track.contact.evaluations = 1;
  const double depth = radius_m(tick) - contact.height_m;
  const FingerStep step{glm::length(finger_way(tick.pose.position, tick.t_s, tick.state).moved),
                        tick.preset.solver.switch_hysteresis_m};
  track.event = kept.place.feature == Feature::none ? TickEvent::first : TickEvent::none;
  if (track.event == TickEvent::none && depth > 0.0)
    track.unentered =
        is_unentered(step, depth, kept.depth_m, !(kept.depth_m > 0.0)) || (kept.unentered && !was_put_elsewhere(step));
  record_exact(track.contact.place, depth, tick);
  return track;
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

Finger section_finger(const Finger& finger) {
  Finger section = finger;
  if (section.shape != FingerShape::point) section.shape = FingerShape::sphere;
  return section;
}

void find_planar_contacts(const PlanarCurve& curve, const TickContext& tick, TickPlanes& planes, TickOutput& out) {
  const Preset& preset = tick.preset;
  const Vec3& centre = tick.local.position;
  const PolygonSurface surface(curve, preset.solver.tolerance_m);
  if (curve.polygon().exact) {
    const PlanarTrack track = find_exact(curve, tick, surface);
    planes = TickPlanes::all(kept_plane(tick, track));
    return describe_smooth(track, tick, out);
  }
  planes = TickPlanes::all(kNoPlane);
  const Method reported = reported_method(preset);
  if (wants_smooth(preset)) {
    SolverSettings settings = preset.solver;
    if (!is_smooth(settings.method)) settings.method = Method::robust;
    PlanarTrack track;
    find_smooth(curve, tick, settings, track, planes, out.way_out_m);
    if (is_smooth(reported)) describe_smooth(track, tick, out);
  }
  if (wants_facet(preset)) {
    const FacetContact facet = surface.nearest(centre);
    const double depth = radius_m(tick) - facet.height_m;
    offer_facet(tick, facet, surface.interpolated_normal(facet), depth, planes, out);
  }
  if (reported == Method::two_pass) find_two_pass_contact(tick, surface, kLeapShare * curve.size_m(), planes, out);
}

}  // namespace tangent
