#include "core/contact/search/height_change.h"

#include "core/contact/follow/step_rule.h"

#include <algorithm>
#include <cmath>

namespace tangent {

HeightChange height_change_along(const Vec3& normal, double height_m) {
  return {normal, 1.0 / std::max(1e-12, std::abs(height_m))};
}

HeightChange height_change_on_face(const SurfaceSample& s, double height_m) {
  HeightChange change = height_change_along(s.normal, height_m);
  const ContactJacobian j = round_jacobian(s, height_m);
  const Vec3 across_u = glm::cross(j.xb, s.normal), across_v = glm::cross(s.normal, j.xa);
  const double area = glm::dot(j.xa, across_u);
  if (area == 0.0) return change;
  const Vec3 du = across_u / area, dv = across_v / area;  // gradients of the contact's u and v
  change.rate -= glm::dot(s.normal, s.point_u) * du + glm::dot(s.normal, s.point_v) * dv;
  const double turning = std::sqrt(glm::dot(s.normal_u, s.normal_u) * glm::dot(du, du)) +
                         std::sqrt(glm::dot(s.normal_v, s.normal_v) * glm::dot(dv, dv));
  change.bend_per_m = std::max(change.bend_per_m, turning);
  return change;
}

double overtaking_margin(const HeightChange& tracked, const HeightChange& rival, double gap, bool is_still) {
  const Vec3 apart = is_still ? rival.rate : tracked.rate - rival.rate;
  const double rate = std::sqrt(glm::dot(apart, apart)) + 1e-3;
  const double bend = tracked.bend_per_m + rival.bend_per_m;
  // Smaller root of rate m + bend m^2 = gap.
  return kOvertakingRoom * 2.0 * gap / (rate + std::sqrt(rate * rate + 4.0 * bend * gap));
}

}  // namespace tangent
