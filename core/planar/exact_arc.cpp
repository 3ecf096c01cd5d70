#include "core/planar/exact_arc.h"

#include "core/base/tolerances.h"

#include <cmath>
#include <numbers>

namespace tangent {

Status check_exact_arc(const ExactArc& arc, const std::string& where) {
  // Written so that a NaN is refused.
  const auto in_reach = [](double value) { return std::abs(value) <= kLargestCoordinate; };
  if (!in_reach(arc.centre.x) || !in_reach(arc.centre.y))
    return fail("the exact arc's centre is not a finite place", where, "write finite coordinates");
  if (!(arc.radius_m > 0.0 && in_reach(arc.radius_m)))
    return fail("the exact arc's radius is not above zero", where, "write a radius in metres");
  if (!(arc.half_angle_rad > 0.0 && arc.half_angle_rad < 0.5 * std::numbers::pi))
    return fail("the exact arc is not between 0 and half a circle", where, "write half its angle in radians");
  if (!(arc.run_out_m >= 0.0 && in_reach(arc.run_out_m)))
    return fail("the exact arc's straight ends have no length", where, "write a length in metres, or 0");
  return {};
}

ExactContact exact_contact(const ExactArc& arc, const Vec2& at) {
  const Vec2 arm = at - arc.centre;
  const double distance = glm::length(arm);
  if (!(distance > 0.0)) return {Feature::face, arc.centre + Vec2(0.0, arc.radius_m), {0.0, 1.0}, -arc.radius_m};
  const double c = std::cos(arc.half_angle_rad), s = std::sin(arc.half_angle_rad);
  const double side = arm.x < 0.0 ? -1.0 : 1.0;
  const Vec2 end_normal(side * s, c), outwards(side * c, -s);  // of the end on the finger's side
  const double past = glm::dot(arm, outwards);                 // beyond the end's normal
  // Within the arc's angle, and so above the centre: the half angle is below a right one.
  if (!(past > 0.0)) {
    const Vec2 normal = arm / distance;
    return {Feature::face, arc.centre + arc.radius_m * normal, normal, distance - arc.radius_m};
  }
  const Vec2 end = arc.centre + arc.radius_m * end_normal;
  if (past > arc.run_out_m) {
    const Vec2 last = end + arc.run_out_m * outwards, to = at - last;
    const double away = glm::length(to);
    return {Feature::vertex, last, to / away, away};
  }
  return {Feature::face, end + past * outwards, end_normal, glm::dot(at - end, end_normal)};
}

}  // namespace tangent
