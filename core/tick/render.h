// From the contacts of a tick to what the devices get, by the rendering condition: force and tactile source are chosen
// apart.
#pragma once

#include "core/baseline/facet.h"
#include "core/baseline/two_pass.h"
#include "core/shading/force_law.h"
#include "core/tick/step.h"

namespace tangent {

/// What a source offers to force and display: a plane in the world and how deep the finger is in it.
struct RenderPlane {
  Vec3 normal{0.0, 0.0, 1.0};
  double penetration_m = 0.0;
  double share = 1.0;  ///< 1; less while an unconverged tick ramps out; 0: nothing to render
};

/// Contacts of one tick: those that the method, the force source and the tactile source ask for.
struct TickContacts {
  RenderPlane smooth_plane, facet_plane, shaded_plane;
  RenderPlane proxy_force, proxy_place;  ///< of the two-pass method: spring, and the surface under the proxy
};

bool is_smooth(Method method);
/// Which contacts a preset asks for; `only_smooth`: the method's own and no other, as most ticks do.
bool only_smooth(const Preset& preset);
bool wants_smooth(const Preset& preset);
bool wants_facet(const Preset& preset);  ///< facet or force shading; the two-pass method finds its own

TickStatus status_of(Feature feature, double penetration_m);
/// 1 for `unconverged_hold_s` after the last converged tick, then falling to 0 over `unconverged_ramp_s`.
double unconverged_share(const SafetySettings& safety, double since_s);

/// Contact and state of the output, for the methods on the raw surface. `origin`: of local coordinates.
void describe_facet(const FacetContact& facet, const RenderPlane& plane, const Vec3& origin, TickOutput& out);

/// The two-pass method's tick: contact, state and output.
void step_two_pass(const ProxySurface& surface, const Preset& preset, const Vec3& centre_local, const Vec3& origin,
                   double leap_m, TickState& state, TickContacts& contacts, TickOutput& out);

/// Of the finger since the last tick, world, m/s; zero where nothing asks for it (no damping) or there was no last
/// tick.
Vec3 finger_velocity(const Preset& preset, const Vec3& position, double t_s, const TickState& state);
/// What the next tick's velocity needs.
void keep_pose(const Vec3& position, double t_s, TickState& state);

/// Force and display of a tick, from the planes of the preset's sources. `velocity`: of the finger, world, m/s.
void render(const Preset& preset, const TickContacts& contacts, const FingerPose& pose, const Vec3& velocity,
            TickOutput& out);

/// What the devices get.
struct Rendered {
  Vec3 force_n{0.0};
  double cld_m = 0.0;
};
/// The same where the one plane is the source of both (only_smooth). `section`: of the finger; `velocity`: as above.
Rendered render(const Preset& preset, const RenderPlane& plane, const FingerSection& section, const Vec3& velocity);

}  // namespace tangent
