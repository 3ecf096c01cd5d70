#include "core/shading/render.h"

#include "core/shading/force_law.h"

#include <algorithm>

namespace tangent {

Rendered render(const Preset& preset, const RenderPlane& force, const RenderPlane* tactile,
                const FingerSection& section, const Vec3& velocity) {
  Rendered out;
  if (tactile && tactile->share > 0.0)  // what takes longest first
    out.cld_m = tactile->share * display_position(preset.display, preset.finger, section, tactile->normal);
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
