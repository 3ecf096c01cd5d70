#include "core/contact/edge_fan.h"

#include "core/contact/place.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

/// A boundary lets the normal turn from the face's front to its back.
constexpr double kBoundaryFan = std::numbers::pi;

Vec3 any_perpendicular(const Vec3& n) {
  const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : std::abs(n.y) < 0.6 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return unit(glm::cross(n, axis));
}

EdgeFan compute_fan(PatchCache& cache, std::uint32_t t, std::uint32_t edge, double f, NormalForm form) {
  const ContactMesh& mesh = cache.mesh();
  const PnPatch& patch = cache.patch(t, form);
  const EdgePoint at = evaluate_edge_point(patch, edge, f);
  const EdgeNormal near = evaluate_edge_normal(patch, edge, f);

  EdgeFan fan;
  fan.point = at.point;
  fan.point_f = at.point_f;
  const double speed2 = glm::dot(at.point_f, at.point_f);
  const Vec3 chord = mesh.position(t, (edge + 1) % 3) - mesh.position(t, edge);
  fan.tangent = unit(speed2 > 1e-12 * glm::dot(chord, chord) ? at.point_f : chord);
  fan.tangent_f = speed2 > 0.0 ? (at.point_ff - glm::dot(at.point_ff, fan.tangent) * fan.tangent) / std::sqrt(speed2) : Vec3(0.0);
  fan.near_normal = near.normal;
  fan.near_normal_f = near.normal_f;
  fan.tilt_near = std::clamp(glm::dot(near.normal, fan.tangent), -1.0, 1.0);
  const Vec3 across = near.normal - fan.tilt_near * fan.tangent;
  fan.e1 = glm::dot(across, across) > 1e-12 ? unit(across) : any_perpendicular(fan.tangent);
  fan.e2 = glm::cross(fan.tangent, fan.e1);
  if (glm::dot(fan.e2, mesh.position(t, (edge + 2) % 3) - mesh.position(t, edge)) > 0.0) fan.e2 = -fan.e2;

  const EdgeLink other = mesh.across(t, edge);
  if (other.triangle == kNone) {
    fan.fan = kBoundaryFan;
    fan.tilt_far = fan.tilt_near;
    fan.far_normal = fan.near_normal;
    fan.far_normal_f = fan.near_normal_f;
    return fan;
  }
  // The neighbour runs along the edge the other way.
  const EdgeNormal far = evaluate_edge_normal(cache.patch(other.triangle, form), other.edge, 1.0 - f);
  fan.far_normal = far.normal;
  fan.far_normal_f = -far.normal_f;
  fan.tilt_far = std::clamp(glm::dot(far.normal, fan.tangent), -1.0, 1.0);
  fan.fan = std::atan2(glm::dot(far.normal, fan.e2), glm::dot(far.normal, fan.e1));
  return fan;
}

}  // namespace

const EdgeFan& edge_fan(PatchCache& cache, std::uint32_t t, std::uint32_t edge, double f, NormalForm form) {
  CachedFan& last = cache.last_fan();
  if (last.triangle != t || last.edge != edge || last.f != f || last.form != form)
    last = {t, edge, f, form, compute_fan(cache, t, edge, f, form)};
  return last.fan;
}

FanNormal fan_normal(const EdgeFan& fan, double turn) {
  const double share = fan.fan != 0.0 ? std::clamp(turn / fan.fan, 0.0, 1.0) : 0.0;
  const double tilt = fan.tilt_near + share * (fan.tilt_far - fan.tilt_near);
  const double tilt_rate = fan.fan != 0.0 ? (fan.tilt_far - fan.tilt_near) / fan.fan : 0.0;
  const double level = std::sqrt(std::max(0.0, 1.0 - tilt * tilt));
  const Vec3 radial = std::cos(turn) * fan.e1 + std::sin(turn) * fan.e2;
  const Vec3 circular = std::cos(turn) * fan.e2 - std::sin(turn) * fan.e1;
  FanNormal n;
  n.normal = tilt * fan.tangent + level * radial;
  n.by_turn = level * circular;
  if (level > 1e-9) n.by_turn += tilt_rate * (fan.tangent - (tilt / level) * radial);
  const Vec3 between = (1.0 - share) * fan.near_normal + share * fan.far_normal;
  const Vec3 by_f = (1.0 - share) * fan.near_normal_f + share * fan.far_normal_f +
                    glm::dot(between - n.normal, fan.tangent_f) * fan.tangent;
  n.by_f = by_f - glm::dot(by_f, n.normal) * n.normal;
  return n;
}

double facing_turn(const EdgeFan& fan, const Finger& finger, const FingerPose& pose) {
  const Vec3 d = pose.position - fan.point;
  double turn = std::atan2(glm::dot(d, fan.e2), glm::dot(d, fan.e1));
  if (finger.shape == FingerShape::point || finger.shape == FingerShape::sphere) return turn;
  // Other shapes: Newton on the component of the travel across the edge, d(travel)/d(turn) = -H dN/d(turn).
  for (int i = 0; i < 20; ++i) {
    const FanNormal n = fan_normal(fan, turn);
    const PlaneContact c = contact_on_plane(finger, pose, fan.point, n.normal);
    const Vec3 across = unit(glm::cross(fan.tangent, n.normal));
    const double residual = glm::dot(c.travel, across);
    const double slope = glm::dot(offset_derivative(finger, pose, n.normal, c.penetration_m) * n.by_turn, across);
    if (!(std::abs(slope) > 0.0)) break;
    const double change = std::clamp(residual / slope, -0.5, 0.5);
    turn += change;
    if (std::abs(change) < 1e-13) break;
  }
  return std::remainder(turn, 2.0 * std::numbers::pi);
}

}  // namespace tangent
