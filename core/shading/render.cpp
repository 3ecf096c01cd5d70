#include "core/shading/render.h"

#include "core/base/tolerances.h"
#include "core/shading/force_law.h"

#include <algorithm>

namespace tangent {

namespace {

/// On the back of the finger, or at its sides, where the angle in the section turns fast and means nothing.
bool is_off_pad(const FingerSection& section, const Vec3& normal) {
  const double distal = glm::dot(normal, section.distal), dorsal = glm::dot(normal, section.dorsal);
  return dorsal < 0.0 || distal * distal + dorsal * dorsal < kPadSection * kPadSection;
}

}  // namespace

Rendered render(const Preset& preset, const RenderPlane& force, const RenderPlane* tactile,
                const FingerSection& section, const Vec3& velocity) {
  Rendered out;
  if (tactile && tactile->share > 0.0) {  // what takes longest first
    out.cld_m = tactile->share * display_position(preset.display, preset.finger, section, tactile->normal);
    out.off_pad = is_off_pad(section, tactile->normal);
  }
  out.ramps_out = force.share < 1.0 && force.share != kRampWasOver;
  if (force.share > 0.0)
    out.force_n = force.share * contact_force(preset.force, force.normal, force.penetration_m, velocity);
  return out;
}

double unconverged_share(const SafetySettings& safety, double since_s) {
  if (since_s <= safety.unconverged_hold_s) return 1.0;
  if (safety.unconverged_ramp_s <= 0.0) return 0.0;
  return std::clamp(1.0 - (since_s - safety.unconverged_hold_s) / safety.unconverged_ramp_s, 0.0, 1.0);
}

}  // namespace tangent
