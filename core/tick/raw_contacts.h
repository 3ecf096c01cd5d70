// The contacts that the smooth methods are compared with, in a tick: facet, force shading and the two-pass proxy, on
// the raw mesh or polygon.
#pragma once

#include "core/baseline/two_pass.h"
#include "core/tick/sources.h"
#include "core/tick/tick_context.h"

namespace tangent {

/// Planes of facet and force shading, both `depth_m` deep; contact and state of the output where one of them is
/// reported. `shaded_normal`: interpolated at the facet contact.
void offer_facet(const TickContext& tick, const FacetContact& facet, const Vec3& shaded_normal, double depth_m,
                 TickPlanes& planes, TickOutput& out);

/// The two-pass method's contact. A proxy further from the finger than `leap_m` is given up.
void find_two_pass_contact(const TickContext& tick, const ProxySurface& surface, double leap_m, TickPlanes& planes,
                           TickOutput& out);

}  // namespace tangent
