#include "core/shading/ramp.h"

#include "core/shading/last_force.h"

#include <algorithm>
#include <cmath>

namespace tangent {

void ramp_what_was_rendered(const Preset& preset, const FingerWay& way, double share, bool display_ramps,
                            const RenderedState& last, Rendered& decided) {
  if (preset.force.blend == ForceBlend::off && !last.changes) return;
  const double ramp_s = preset.safety.unconverged_ramp_s;
  const double before = ramp_s > 0.0 ? std::min(1.0, share + way.dt_s / ramp_s) : 1.0;
  const double left = before > 0.0 ? share / before : 0.0;
  const double stiffness = std::max(preset.force.stiffness_n_per_m, last.stiffness_n_per_m);
  const bool deeper = glm::dot(last.force_n, way.moved) < 0.0;  // pushes no more for it
  Vec3 force = left * (deeper ? last.force_n : left_of_last(last.force_n, way.moved, stiffness));
  limit_force(preset, force);
  if (glm::distance(decided.force_n, force) > most_force_change_n(preset, way)) decided.force_n = force;
  const double cld_m = left * last.cld_m;
  if (display_ramps && std::abs(decided.cld_m - cld_m) > most_display_change_m(preset, way)) decided.cld_m = cld_m;
}

}  // namespace tangent
