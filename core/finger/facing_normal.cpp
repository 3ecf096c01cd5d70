// penetration(N) = max over the finger's x of (point - x).N, the support function of the finger seen from the point.
// Along the sphere of normals its gradient is -travel and its second derivative H (plane_contact.h), so the travel
// vanishes where it is stationary, and a descent on it from anywhere ends at such a place. Newton's steps alone do not:
// on the flank of a long finger p(N) runs from one end to the other while N turns by a hundredth, and they overshoot.
#include "core/finger/facing_normal.h"

#include "core/finger/plane_contact.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// rad. Longer steps leave the neighbourhood in which the derivatives say anything.
constexpr double kLongestTurn = 0.3;
/// rad. Below this Newton's steps square the error, and the penetration changes by less than its rounding.
constexpr double kNewtonTurn = 1e-6;
/// rad. A unit vector is rounded by more.
constexpr double kNoTurn = 1e-15;

/// Newton's step down `sign` * penetration with the second derivative's eigenvalues taken as positive: downhill
/// wherever it is, and Newton's own at a minimum.
Vec3 downhill_turn(const Mat3& h, double sign, const Vec3& normal, const Vec3& travel) {
  const Vec3 a = unit(glm::cross(normal, std::abs(normal.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 b = glm::cross(normal, a);
  const Vec3 ha = h * a;
  const double haa = glm::dot(a, ha), hab = glm::dot(b, ha), hbb = glm::dot(b, h * b);
  const double mean = 0.5 * (haa + hbb), half = 0.5 * (haa - hbb), radius = std::hypot(half, hab);
  const double angle = 0.5 * std::atan2(hab, half);
  const Vec3 first = std::cos(angle) * a + std::sin(angle) * b, second = std::cos(angle) * b - std::sin(angle) * a;
  const double least = 1e-9 * (std::abs(mean) + radius);
  const double bend1 = std::max(std::abs(mean + radius), least), bend2 = std::max(std::abs(mean - radius), least);
  if (!(least > 0.0)) return Vec3(0.0);
  const Vec3 turn = sign * ((glm::dot(travel, first) / bend1) * first + (glm::dot(travel, second) / bend2) * second);
  const double size = std::sqrt(glm::dot(turn, turn));
  return size > kLongestTurn ? (kLongestTurn / size) * turn : turn;
}

/// Where the descent begins: facing the finger's centre, or from before a capsule the nearest place of its axis.
Vec3 first_normal(const Finger& finger, const FingerPose& pose, const Vec3& d, FacingSide side) {
  if (side == FacingSide::back) return unit(-d);
  if (finger.shape != FingerShape::capsule) return unit(d);
  const Vec3 half = finger.half_length_m * section_of(pose.orientation).distal;
  const Vec3 towards = towards_axis(d, half, -glm::dot(d, half) / glm::dot(half, half));
  return towards != Vec3(0.0) ? unit(towards) : unit(d);
}

}  // namespace

Vec3 towards_axis(const Vec3& d, const Vec3& half, double along) {
  constexpr double kNearEnd = 0.999;
  const double length = glm::length(half);
  if (!(length > 0.0) || std::isnan(along)) return d;
  const double g = std::clamp(along, -kNearEnd, kNearEnd);
  const Vec3 towards = d + g * half;
  return towards - (kSpindle * g / std::sqrt(1.0 - g * g) * glm::length(towards) / length) * half;
}

Vec3 facing_normal(const Finger& finger, const FingerPose& pose, const Vec3& point, const Vec3& start,
                   FacingSide side) {
  constexpr int kTurns = 60, kHalvings = 40;
  const double sign = side == FacingSide::front ? 1.0 : -1.0;
  const Vec3 d = pose.position - point;
  const double d2 = glm::dot(d, d);
  if (is_round(finger)) return d2 > 0.0 ? sign * d / std::sqrt(d2) : start;
  Vec3 normal = d2 > 0.0 ? first_normal(finger, pose, d, side) : start;
  PlaneContact c = contact_on_plane(finger, pose, point, normal);
  for (int i = 0; i < kTurns; ++i) {
    Vec3 turn = downhill_turn(offset_derivative(finger, pose, normal, c.penetration_m), sign, normal, c.travel);
    const double size = std::sqrt(glm::dot(turn, turn));
    if (!(size > kNoTurn)) break;
    for (int k = 0; k < kHalvings; ++k, turn *= 0.5) {
      const Vec3 turned = unit(normal + turn);
      const PlaneContact there = contact_on_plane(finger, pose, point, turned);
      if (size > kNewtonTurn && !(sign * there.penetration_m < sign * c.penetration_m)) continue;
      normal = turned;
      c = there;
      break;
    }
  }
  return normal;
}

}  // namespace tangent
