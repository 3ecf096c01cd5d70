#include "core/tick/mesh_contacts.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/iterate.h"
#include "core/contact/prove/clearance_check.h"
#include "core/shading/way_out.h"
#include "core/tick/raw_contacts.h"
#include "core/tick/rendering.h"
#include "core/tick/smooth_contact.h"
#include "core/tick/walls.h"

#include <algorithm>

namespace tangent {
namespace {

/// The way out of the tracked plane and the others, which push together; zero where there are no others.
Vec3 way_out_of(const TickContext& tick, const IterationResult& tracked, const TouchedContacts& touched) {
  if (touched.count == 0 || !tracked.converged()) return Vec3(0.0);
  const TouchedPlane first = touched_plane(tracked.plane, tracked.contact);
  const double tolerance = tick.preset.solver.tolerance_m;
  PushingPlanes planes;
  if (!tick.state.unentered) planes.add({tracked.plane.normal, tracked.contact.penetration_m, 1.0});
  for (const TouchedContact& c : touched.all())
    if (pushes_beside(first, touched_plane(c.plane, c.contact), touched.with_walls, tolerance))
      planes.add({c.plane.normal, c.contact.penetration_m, 1.0});
  return planes.way_out();
}

/// `way_out` where there is one, else that of the tracked contact alone.
Vec3 way_out_or_one(const TickContext& tick, const IterationResult& tracked, const Vec3& way_out) {
  if (way_out != Vec3(0.0) || tick.state.unentered) return way_out;
  return std::max(0.0, tracked.contact.penetration_m) * tracked.plane.normal;
}

/// Whether the finger's centre was behind the kept plane at the last tick, where that pushed.
bool was_behind(const TickContext& tick, const TrackedPlane& kept) {
  return !tick.state.unentered && glm::dot(tick.state.last_position - tick.origin - kept.point, kept.normal) < 0.0;
}

/// The way out of what the last tick left, the `kept` plane and those of `places`, for the finger as it is now. A plane
/// that its centre has come behind since then pushed, too; where the centre was behind the kept one, that pushed alone,
/// or with walls.
Vec3 last_way_out(ContactContext& context, const TickContext& tick, const TrackedPlane& kept,
                  const TouchedPlaces& places, int& evaluations) {
  const auto plane_at = [&](const TrackedPlane& at) {
    return RenderPlane{at.normal, contact_on_plane(tick.finger, tick.local, at.point, at.normal).penetration_m, 1.0};
  };
  PushingPlanes planes;
  const Vec3 was_at = tick.state.last_position - tick.origin;
  const TouchedPlane first{kept.point, kept.normal, was_behind(tick, kept)};
  const FingerPose was{was_at, tick.state.last_orientation};
  ContactContext then{context.cache, context.settings, context.finger, was, context.origin};
  const bool with_walls = can_lack_walls(context.cache.mesh(), tick.finger, was_at, kept, places);
  if (!tick.state.unentered) planes.add(plane_at(kept));
  for (const SurfacePlace& place : std::span(places.places).first(places.count)) {
    TrackedPlane at;
    at.move_to(place);
    SurfaceSample sample;
    sample_place(then, at, sample);  // on edges the normal faced the finger
    const TouchedPlane there{at.point, at.normal, glm::dot(was_at - at.point, at.normal) < 0.0};
    if (pushes_beside(first, there, with_walls, context.settings.tolerance_m)) planes.add(plane_at(at));
    ++evaluations;
  }
  return planes.way_out();
}

/// How far the furthest point of the finger has come since the last tick: no depth changes by more. Of a finger that is
/// not round its turning counts, too.
double finger_way_m(const TickContext& tick) {
  const double way = glm::length(finger_way(tick.pose.position, tick.t_s, tick.state).moved);
  if (is_round(tick.finger) || !tick.state.has_previous) return way;
  return way + turned_m(tick.finger, tick.state.last_orientation, tick.pose.orientation);
}

/// The smooth contact by `settings`; updates what the next tick keeps of it. `way_out`: of all places that are touched,
/// where the preset asks for them and there are several; else zero.
inline void find_smooth(const ContactScene& scene, StepCache& cache, const TickContext& tick,
                        const SolverSettings& settings, TickPlanes& planes, Vec3& way_out) {
  RenderPlane& plane = planes.smooth;
  const bool all = wants_touched(tick.preset);
  cache.last_touched.count = 0;
  if (tick.state.touched.count > 0) cache.last_touched = tick.state.touched;
  const Vec3 moved = finger_way(tick.pose.position, tick.t_s, tick.state).moved;
  ContactContext context{cache.patches, settings, tick.finger,        tick.local, tick.origin,
                         tick.trace,    0,        finger_way_m(tick), moved};
  context.in_real_time = !tick.all_at_once;
  cache.patches.expect_around(tick.state.plane.triangle);
  const bool sample_is_kept = cache.holds(tick.state.plane, settings.normal_form);
  find_smooth_contact(context, scene.search(), sample_is_kept, tick.state, cache.smooth,
                      all ? &cache.touched : nullptr);
  cache.form = settings.normal_form;
  const IterationResult& contact = cache.smooth.contact;
  DecidedContact& decided = cache.smooth;
  const bool may_leap = all && decided.places_changed && decided.converged() && decided.event == TickEvent::none;
  const Vec3 before =
      may_leap ? last_way_out(context, tick, tick.state.plane, cache.last_touched, decided.evaluations) : Vec3(0.0);
  tick.state.plane = contact.plane;
  cache.patches.expect_around(contact.plane.triangle);
  if (cache.smooth.converged()) {
    const double depth = contact.contact.penetration_m;
    keep_converged_plane(tick, tick.state.unentered ? std::min(0.0, depth) : depth, plane);
  } else {
    plane = last_converged_plane(tick);
  }
  if (!all) return;
  planes.touched = plane;
  if (cache.touched.count > 0) {  // few ticks
    way_out = way_out_of(tick, contact, cache.touched);
    planes.touched = plane_of_way_out(way_out, plane);
  }
  if (may_leap &&
      has_leapt(before, way_out_or_one(tick, contact, way_out), context.moved_m, settings.switch_hysteresis_m))
    decided.event = TickEvent::switched;  // another set of places pushes
}

void describe_smooth(const DecidedContact& decided, const TickContext& tick, TickOutput& out) {
  const IterationResult& c = decided.contact;
  out.status = decided.facing() ? TickStatus::facing : TickStatus::unconverged;
  if (decided.converged())
    out.status = tick.state.unentered ? TickStatus::free : status_of(c.plane.feature, c.contact.penetration_m);
  out.event = decided.event;
  out.triangle = c.plane.triangle;
  out.u = c.plane.u;
  out.v = c.plane.v;
  out.contact = tick.origin + c.plane.point;
  out.normal = c.plane.normal;
  out.penetration_m = c.contact.penetration_m;
  out.error_m = c.contact.error_m;
  out.iterations = decided.evaluations;
  out.triangle_changes = decided.triangle_changes;
  out.searching = decided.searching;
}

/// Facet and force shading.
void find_facet(const ContactScene& scene, const TickContext& tick, TickPlanes& planes, TickOutput& out) {
  const ContactMesh& mesh = scene.mesh();
  const FacetContact facet = facet_contact(mesh, scene.nearest(), tick.local.position, tick.preset.solver.tolerance_m);
  if (!facet.found) return;
  const double depth = contact_on_plane(tick.finger, tick.local, facet.hit.point, facet.normal).penetration_m;
  offer_facet(tick, facet, force_shading_normal(mesh, facet), depth, planes, out);
}

void find_two_pass(const ContactScene& scene, const TickContext& tick, TickPlanes& planes, TickOutput& out) {
  constexpr double kLeapShare = 0.25;  // of the box's diagonal: a proxy further from the finger is given up
  const MeshProxySurface surface(scene.mesh(), scene.nearest(), tick.preset.solver.tolerance_m);
  find_two_pass_contact(tick, surface, kLeapShare * glm::length(scene.mesh().bounds().size()), planes, out);
}

}  // namespace

void find_mesh_contacts(const ContactScene& scene, StepCache& cache, const TickContext& tick, TickPlanes& planes,
                        TickOutput& out) {
  const Preset& preset = tick.preset;
  if (only_smooth(preset)) {  // most ticks
    find_smooth(scene, cache, tick, preset.solver, planes, out.way_out_m);
    return describe_smooth(cache.smooth, tick, out);
  }
  planes = TickPlanes::all(kNoPlane);
  const Method reported = reported_method(preset);
  if (wants_smooth(preset)) {
    SolverSettings settings = preset.solver;
    if (!is_smooth(settings.method)) settings.method = Method::robust;
    find_smooth(scene, cache, tick, settings, planes, out.way_out_m);
    if (is_smooth(reported)) describe_smooth(cache.smooth, tick, out);
  }
  if (wants_facet(preset)) find_facet(scene, tick, planes, out);
  if (reported == Method::two_pass) find_two_pass(scene, tick, planes, out);
}

}  // namespace tangent
