#include "workbench/session/hand_lead.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kApproachTime = 0.5;     // s from off the surface to the full press
constexpr double kApproachHeight = 3e-3;  // m
// m/s; of the hand itself. On a path around a small feature the finger's centre moves faster than its pad; a click far
// away moves the hand there at this speed.
constexpr double kHandSpeedLimit = 1.0;

Vec3 shortened(const Vec3& move, double farthest_m) {
  const double far = std::sqrt(glm::dot(move, move));
  return far > farthest_m ? move * (farthest_m / far) : move;
}

}  // namespace

PathPose HandLead::wanted(const ExplorationPath& path, double pad_m) const noexcept {
  if (command_.settings.mode == HandMode::point) return {command_.point_m, goal_.orientation};
  const double t = std::min(1.0, approach_s_ / kApproachTime);
  const double eased = t * t * (3.0 - 2.0 * t);
  const double press = eased * (command_.settings.press_m + kApproachHeight) - kApproachHeight;
  return path.at(way_m_, pad_m, press);
}

HandTarget HandLead::begin(const ExplorationPath& path, double pad_m) noexcept {
  way_m_ = approach_s_ = 0.0;
  goal_ = path.at(0.0, pad_m, -kApproachHeight);
  return {goal_.position_m, Vec3(0.0), goal_.orientation};
}

Vec3 HandLead::led_move(const Vec3& to_m, const Vec3& finger_m, double dt_s, double scale) noexcept {
  const bool by_point = command_.settings.mode == HandMode::point;
  const double speed = std::max(command_.point_speed_m_per_s, by_point ? 0.0 : 2.0 * command_.settings.speed_m_per_s);
  const double longest_m = command_.longest_lead_m * scale;
  led_ = by_point || glm::length(to_m - goal_.position_m) > longest_m;
  const Vec3 move = shortened(to_m - goal_.position_m, speed * scale * dt_s);
  const Vec3 lead = goal_.position_m - finger_m;
  const double now_m = glm::length(lead);
  if (glm::length(lead + move) <= std::max(now_m, longest_m)) return move;
  // Only round the finger. The hand is not drawn back to it: a target that follows the finger has no damping.
  return now_m > 0.0 ? move - lead * (std::max(0.0, glm::dot(move, lead)) / (now_m * now_m)) : Vec3(0.0);
}

HandTarget HandLead::advance(const ExplorationPath& path, double pad_m, const Vec3& finger_m, double dt_s,
                             double scale) noexcept {
  if (command_.settings.mode == HandMode::explore) {
    const double speed = std::clamp(command_.settings.speed_m_per_s, 0.0, kFastestHand);
    way_m_ = std::fmod(way_m_ + speed * dt_s, path.length_m());
    approach_s_ += dt_s;
  }
  const PathPose next = wanted(path, pad_m);
  const Vec3 move = led_ ? led_move(next.position_m, finger_m, dt_s, scale)
                         : shortened(next.position_m - goal_.position_m, kHandSpeedLimit * scale * dt_s);

  // The position at the start of this tick; the device extrapolates it with the velocity until the tick's end.
  HandTarget target{goal_.position_m, move / dt_s, next.orientation};
  goal_ = {goal_.position_m + move, next.orientation};
  return target;
}

}  // namespace tangent
