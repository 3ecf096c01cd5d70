#include "core/tick/render.h"

#include <algorithm>

namespace tangent {
namespace {

const RenderPlane& force_plane(const Preset& preset, const TickContacts& contacts) {
  switch (preset.force.source) {
    case ForceSource::facet:
      return contacts.facet_plane;
    case ForceSource::force_shading:
      return contacts.shaded_plane;
    case ForceSource::smooth:
      return contacts.smooth_plane;
    case ForceSource::method:
      break;
  }
  switch (preset.solver.method) {
    case Method::facet:
      return contacts.facet_plane;
    case Method::force_shading:
      return contacts.shaded_plane;
    case Method::two_pass:
      return contacts.proxy_force;
    default:
      return contacts.smooth_plane;
  }
}

/// Null: the display is held at its centre.
const RenderPlane* tactile_plane(const Preset& preset, const TickContacts& contacts) {
  switch (preset.display.source) {
    case TactileSource::held:
      return nullptr;
    case TactileSource::facet:
      return &contacts.facet_plane;
    case TactileSource::smooth:
      return &contacts.smooth_plane;
    case TactileSource::method:
      break;
  }
  if (preset.solver.method == Method::two_pass) return &contacts.proxy_place;
  return is_smooth(preset.solver.method) ? &contacts.smooth_plane : &contacts.facet_plane;
}

Vec3 rendered_force(const Preset& preset, const RenderPlane& plane, const Vec3& velocity) {
  return plane.share > 0.0 ? plane.share * contact_force(preset.force, plane.normal, plane.penetration_m, velocity)
                           : Vec3(0.0);
}

double rendered_place(const Preset& preset, const RenderPlane& plane, const FingerSection& section) {
  return plane.share > 0.0 ? plane.share * display_position(preset.display, preset.finger, section, plane.normal) : 0.0;
}

}  // namespace

bool is_smooth(Method m) { return m == Method::paper || m == Method::newton || m == Method::robust; }

bool wants_smooth(const Preset& preset) {
  return is_smooth(preset.solver.method) || preset.force.source == ForceSource::smooth ||
         preset.display.source == TactileSource::smooth;
}

bool only_smooth(const Preset& preset) { return is_smooth(preset.solver.method) && !wants_facet(preset); }

bool wants_facet(const Preset& preset) {
  return preset.solver.method == Method::facet || preset.solver.method == Method::force_shading ||
         preset.force.source == ForceSource::facet || preset.force.source == ForceSource::force_shading ||
         preset.display.source == TactileSource::facet;
}

TickStatus status_of(Feature feature, double penetration_m) {
  if (penetration_m < 0.0) return TickStatus::free;
  switch (feature) {
    case Feature::edge:
      return TickStatus::edge;
    case Feature::vertex:
      return TickStatus::vertex;
    default:
      return TickStatus::face;
  }
}

double unconverged_share(const SafetySettings& safety, double since_s) {
  if (since_s <= safety.unconverged_hold_s) return 1.0;
  if (safety.unconverged_ramp_s <= 0.0) return 0.0;
  return std::clamp(1.0 - (since_s - safety.unconverged_hold_s) / safety.unconverged_ramp_s, 0.0, 1.0);
}

void describe_facet(const FacetContact& facet, const RenderPlane& plane, const Vec3& origin, TickOutput& out) {
  if (!facet.found) return;
  out.status = status_of(facet.feature, plane.penetration_m);
  out.triangle = facet.hit.triangle;
  out.u = facet.hit.u;
  out.v = facet.hit.v;
  out.contact = origin + facet.hit.point;
  out.normal = plane.normal;
  out.penetration_m = plane.penetration_m;
}

void step_two_pass(const ProxySurface& surface, const Preset& preset, const Vec3& centre_local, const Vec3& origin,
                   double leap_m, TickState& state, TickContacts& contacts, TickOutput& out) {
  const double radius = preset.finger.shape == FingerShape::point ? 0.0 : preset.finger.radius_m;
  const Vec3* kept = state.has_proxy ? &state.proxy : nullptr;
  const TwoPassContact contact =
      two_pass_contact(surface, centre_local, radius, preset.solver.tolerance_m, kept, leap_m);
  state.has_proxy = contact.found ? 1 : 0;
  if (!contact.found) {
    contacts.proxy_force.share = contacts.proxy_place.share = 0.0;
    return;
  }
  state.proxy = contact.proxy;
  contacts.proxy_force = {contact.normal, contact.penetration_m, 1.0};
  contacts.proxy_place = {contact.facet.normal, contact.penetration_m, 1.0};
  describe_facet(contact.facet, contacts.proxy_force, origin, out);
}

Vec3 finger_velocity(const Preset& preset, const Vec3& position, double t_s, const TickState& state) {
  const double dt = t_s - state.last_t_s;
  if (preset.force.damping_n_s_per_m == 0.0 || !state.has_previous || !(dt > 0.0)) return Vec3(0.0);
  return (position - state.last_position) / dt;
}

void keep_pose(const Vec3& position, double t_s, TickState& state) {
  state.last_position = position;
  state.last_t_s = t_s;
  state.has_previous = 1;
}

void render(const Preset& preset, const TickContacts& contacts, const FingerPose& pose, const Vec3& velocity,
            TickOutput& out) {
  out.force_n = rendered_force(preset, force_plane(preset, contacts), velocity);
  if (const RenderPlane* tactile = tactile_plane(preset, contacts))
    out.cld_m = rendered_place(preset, *tactile, section_of(pose.orientation));
}

Rendered render(const Preset& preset, const RenderPlane& plane, const FingerSection& section, const Vec3& velocity) {
  const double place = preset.display.source != TactileSource::held ? rendered_place(preset, plane, section)
                                                                    : 0.0;  // what takes longest first
  return {rendered_force(preset, plane, velocity), place};
}

}  // namespace tangent
