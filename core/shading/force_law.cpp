#include "core/shading/force_law.h"

#include <algorithm>

namespace tangent {

Vec3 contact_force(const ForceSettings& settings, const Vec3& normal, double penetration_m, const Vec3& velocity) {
  if (!(penetration_m > 0.0)) return Vec3(0.0);
  const double push =
      settings.stiffness_n_per_m * penetration_m - settings.damping_n_s_per_m * glm::dot(velocity, normal);
  return std::clamp(push, 0.0, settings.limit_n) * normal;
}

double display_position(const DisplaySettings& settings, const Finger& finger, const FingerSection& section,
                        const Vec3& normal) {
  // A little past the stop, so that the clamp below decides what is rendered there.
  const double stop = (1.0 + 1e-9) * 0.5 * settings.finger_arc_m;
  const double arc = contact_arc_m(finger, section, normal, stop);
  const double half = 0.5 * settings.travel_m;
  return std::clamp(arc * (settings.travel_m / settings.finger_arc_m), -half, half);
}

}  // namespace tangent
