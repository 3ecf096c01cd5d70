#include "core/tick/raw_contacts.h"

namespace tangent {
namespace {

void describe(const TickContext& tick, const FacetContact& facet, const RenderPlane& plane, TickOutput& out) {
  if (!facet.found) return;
  out.status = status_of(facet.feature, plane.penetration_m);
  out.triangle = facet.hit.triangle;
  out.u = facet.hit.u;
  out.v = facet.hit.v;
  out.contact = tick.origin + facet.hit.point;
  out.normal = plane.normal;
  out.penetration_m = plane.penetration_m;
}

}  // namespace

void offer_facet(const TickContext& tick, const FacetContact& facet, const Vec3& shaded_normal, double depth_m,
                 TickPlanes& planes, TickOutput& out) {
  planes.facet = {facet.normal, depth_m, 1.0};
  planes.shaded = {shaded_normal, depth_m, 1.0};
  const Method reported = reported_method(tick.preset);
  if (reported == Method::facet) describe(tick, facet, planes.facet, out);
  if (reported == Method::force_shading) describe(tick, facet, planes.shaded, out);
}

void find_two_pass_contact(const TickContext& tick, const ProxySurface& surface, double leap_m, TickPlanes& planes,
                           TickOutput& out) {
  const double radius = tick.finger.shape == FingerShape::point ? 0.0 : tick.finger.radius_m;
  const Vec3* kept = tick.state.has_proxy ? &tick.state.proxy : nullptr;
  const TwoPassContact contact =
      two_pass_contact(surface, tick.local.position, radius, tick.preset.solver.tolerance_m, kept, leap_m);
  tick.state.has_proxy = contact.found ? 1 : 0;
  if (!contact.found) {
    planes.proxy_force.share = planes.proxy_place.share = 0.0;
    return;
  }
  tick.state.proxy = contact.proxy;
  planes.proxy_force = {contact.normal, contact.penetration_m, 1.0};
  planes.proxy_place = {contact.facet.normal, contact.penetration_m, 1.0};
  describe(tick, contact.facet, planes.proxy_force, out);
}

}  // namespace tangent
