#include "core/contact/edge_fan.h"

#include "core/base/tolerances.h"
#include "core/finger/facing_normal.h"
#include "core/finger/plane_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

Vec3 any_perpendicular(const Vec3& n) {
  const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : std::abs(n.y) < 0.6 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return unit(glm::cross(n, axis));
}

bool constant(const EdgeNormals& n) {
  return glm::length(n.powers[1]) <= kStraightEdge && glm::length(n.powers[2]) <= kStraightEdge;
}

bool is_straight(const FanEdge& edge) {
  const double room = kStraightEdge * std::sqrt(edge.chord2);
  const Vec3 start = evaluate(edge.curve, 0.0).point_f, end = evaluate(edge.curve, 1.0).point_f;
  return glm::distance(start, edge.chord) <= room && glm::distance(end, edge.chord) <= room && edge.flat_near &&
         (edge.boundary || edge.flat_far);
}

/// Where all coefficients of a side's normals are the same, there is nothing to evaluate.
EdgeNormal side_normal(const EdgeNormals& side, bool flat, double f) {
  return flat ? EdgeNormal{side.powers[0], Vec3(0.0), side.powers[0]} : evaluate(side, f);
}

/// Where the near side's normal runs along the edge: any frame across it.
void span_any_frame(const FanEdge& edge, EdgeFan& fan) {
  fan.per_along = 1.0;
  fan.across = fan.e1 = any_perpendicular(fan.tangent);
  fan.beyond = glm::cross(fan.tangent, fan.across);
  if (glm::dot(fan.beyond, edge.inwards) > 0.0) fan.beyond = -fan.beyond;
  fan.e2 = fan.beyond;
}

/// The curve's point and tangent and the near side's normal, with the frame that they span.
void set_near_side(const FanEdge& edge, const EdgePoint& at, const EdgeNormal& near, EdgeFan& fan) {
  const double speed2 = glm::dot(at.point_f, at.point_f);
  const bool moves = speed2 > 1e-12 * edge.chord2;
  const Vec3 along = moves ? at.point_f : edge.chord;
  const double along2 = moves ? speed2 : edge.chord2;
  fan.point = at.point;
  fan.point_f = at.point_f;
  fan.across = along2 * near.unscaled - glm::dot(near.unscaled, along) * along;
  const double across2 = glm::dot(fan.across, fan.across);
  const double per_along = 1.0 / std::sqrt(along2), per_across = 1.0 / std::sqrt(across2);
  fan.per_along = per_along;
  fan.tangent = per_along * along;
  fan.beyond = glm::cross(along, fan.across);
  if (glm::dot(fan.beyond, edge.inwards) > 0.0) fan.beyond = -fan.beyond;
  fan.e1 = per_across * fan.across;
  fan.e2 = (per_across * per_along) * fan.beyond;
  fan.tangent_f = moves ? per_along * (at.point_ff - glm::dot(at.point_ff, fan.tangent) * fan.tangent) : Vec3(0.0);
  fan.near_normal = near.normal;
  fan.near_normal_f = near.normal_f;
  fan.tilt_near = std::clamp(glm::dot(near.normal, fan.tangent), -1.0, 1.0);
  if (!(across2 > 1e-12 * along2 * along2 * glm::dot(near.unscaled, near.unscaled))) span_any_frame(edge, fan);
}

/// A boundary lets the normal turn from the face's front to its back.
void set_boundary(EdgeFan& fan) {
  fan.far_normal = fan.near_normal;
  fan.far_normal_f = fan.near_normal_f;
  fan.tilt_far = fan.tilt_near;
  fan.far = {-1.0, 0.0};
  fan.cot_half = 0.0;
  fan.even = true;
}

/// The other side's normal.
void set_far_side(const EdgeNormal& far, EdgeFan& fan) {
  fan.far_normal = far.normal;
  fan.far_normal_f = far.normal_f;
  fan.tilt_far = std::clamp(glm::dot(far.normal, fan.tangent), -1.0, 1.0);
  const TurnTriangle turn = turn_triangle(fan, far.unscaled);
  fan.far = unit_turn(turn);
  fan.cot_half = turn.y != 0.0 ? (turn.length + turn.x) / turn.y : 0.0;  // half a circle: 0
  fan.even = false;
}

/// Without what rounding leaves of bends and leanings along a straight edge.
void straighten(const FanEdge& edge, EdgeFan& fan) {
  fan.point_f = edge.chord;
  fan.tangent_f = fan.near_normal_f = fan.far_normal_f = Vec3(0.0);
  if (std::abs(fan.tilt_far - fan.tilt_near) <= 2.0 * kStraightEdge) fan.tilt_far = fan.tilt_near;
  if (std::abs(fan.tilt_near) <= 2.0 * kStraightEdge && fan.tilt_far == fan.tilt_near)
    fan.tilt_near = fan.tilt_far = 0.0;
  fan.even = fan.tilt_near == fan.tilt_far;
  fan.uniform = fan.tilt_near == 0.0 && fan.tilt_far == 0.0;
  fan.start = edge.curve.origin + edge.curve.powers[0];
  fan.per_length2 = 1.0 / edge.chord2;
}

void set_fan(const FanEdge& edge, double f, EdgeFan& fan) {
  const EdgePoint at = evaluate(edge.curve, f);
  const EdgeNormal near = side_normal(edge.near, edge.flat_near, f);
  if (edge.boundary) {
    set_near_side(edge, at, near, fan);
    set_boundary(fan);
  } else {
    const EdgeNormal far = side_normal(edge.far, edge.flat_far, f);
    set_near_side(edge, at, near, fan);
    set_far_side(far, fan);
  }
  if (edge.straight) straighten(edge, fan);
}

}  // namespace

void prepare_fan(FanEdge& edge, EdgeFan& fan) {
  edge.chord2 = glm::dot(edge.chord, edge.chord);
  edge.flat_near = constant(edge.near);
  edge.flat_far = !edge.boundary && constant(edge.far);
  edge.straight = is_straight(edge);
  fan.uniform = false;
  if (edge.straight) set_fan(edge, 0.0, fan);
}

void move_fan(const FanEdge& edge, double f, EdgeFan& fan) {
  if (!edge.straight) {
    set_fan(edge, f, fan);
  } else if (fan.uniform) {
    fan.point = uniform_point(fan, f);
  } else {
    fan.point = edge.curve.origin + (edge.curve.powers[0] + f * edge.chord);
  }
}

Vec2 clamp_turn(const EdgeFan& fan, const Vec2& turn) {
  if (in_fan(fan, turn)) return turn;
  return fan.convex() && glm::dot(turn, fan.far) > turn.x ? fan.far : kNearTurn;
}

namespace {

/// The travel across an edge, as its normal turns: with d from the fan's point to the finger's centre, e' the
/// direction across edge and normal, and A the core's axes (finger/finger_core.h), it is d.e' - A N.A e' / |A N|; the
/// ball's part runs along N. All in the frame of the edge, so that a turn takes few products.
class TravelAcross {
 public:
  TravelAcross(const EdgeFan& fan, const Finger& finger, const FingerPose& pose) : fan_(fan) {
    const Mat3 rotation = glm::mat3_cast(pose.orientation);
    const Vec3 axes = core_axes_m(finger), d = pose.position - fan.point;
    along_ = axes * (fan.tangent * rotation);
    across1_ = axes * (fan.e1 * rotation);
    across2_ = axes * (fan.e2 * rotation);
    d_ = {glm::dot(d, fan.e1), glm::dot(d, fan.e2)};
  }

  /// m; `rate`: how fast it becomes less as the turn grows, m/rad.
  double at(const Vec2& turn, double& rate) const {
    const FanTilt tilt = tilt_at(fan_, turn);
    const Vec3 radial = turn.x * across1_ + turn.y * across2_, across = turn.x * across2_ - turn.y * across1_;
    const Vec3 an = tilt.tilt * along_ + tilt.level * radial;
    Vec3 turned = tilt.level * across;
    if (tilt.rate != 0.0 && tilt.level > 1e-9) turned += tilt.rate * (along_ - (tilt.tilt / tilt.level) * radial);
    const double length2 = glm::dot(an, an), per = length2 > 0.0 ? 1.0 / std::sqrt(length2) : 0.0;
    const double leans = glm::dot(an, across);
    rate = d_.x * turn.x + d_.y * turn.y +
           per * (glm::dot(turned, across) - glm::dot(an, radial) - per * per * leans * glm::dot(an, turned));
    return d_.y * turn.x - d_.x * turn.y - per * leans;
  }

 private:
  const EdgeFan& fan_;
  Vec3 along_, across1_, across2_;  ///< A times the frame, m, in the finger's
  Vec2 d_;
};

/// Where the search for a turn begins: facing the finger's centre, or of a capsule the place of its axis that is
/// nearest, seen along the edge.
Vec2 first_turn(const EdgeFan& fan, const Finger& finger, const FingerPose& pose) {
  const Vec3 d = pose.position - fan.point;
  if (finger.shape != FingerShape::capsule) return turn_of(fan, d);
  const Vec3 half = finger.half_length_m * section_of(pose.orientation).distal;
  const Vec2 seen(glm::dot(half, fan.e1), glm::dot(half, fan.e2)), from(glm::dot(d, fan.e1), glm::dot(d, fan.e2));
  return turn_of(fan, towards_axis(d, half, -glm::dot(from, seen) / glm::dot(seen, seen)));
}

}  // namespace

Vec2 facing_turn(const EdgeFan& fan, const Finger& finger, const FingerPose& pose) {
  Vec2 turn = first_turn(fan, finger, pose);
  if (is_round(finger)) return turn;
  // Other shapes: Newton on the travel across. Where its rate is positive, the least penetration lies further on
  // (finger/facing_normal.h). On the flank of a long finger Newton's steps overshoot it for ever, so they are kept
  // between the turns that were too small and those that were too large.
  constexpr double kLongest = 0.5, kSameTurn = 1e-13;  // rad
  const TravelAcross travel(fan, finger, pose);
  double angle = 0.0, too_small = -std::numeric_limits<double>::infinity(), too_large = -too_small;
  for (int i = 0; i < 40; ++i) {
    double rate = 0.0;
    const double residual = travel.at(turn, rate);
    if (residual == 0.0) break;
    (residual > 0.0 ? too_small : too_large) = angle;
    double change = rate > 0.0 ? std::clamp(residual / rate, -kLongest, kLongest) : std::copysign(kLongest, residual);
    const bool last = std::abs(change) < kSameTurn;
    if (!last && !(angle + change > too_small && angle + change < too_large))
      change = 0.5 * (too_small + too_large) - angle;
    angle += change;
    const double c1 = std::cos(change), s1 = std::sin(change);
    turn = {c1 * turn.x - s1 * turn.y, s1 * turn.x + c1 * turn.y};
    turn /= glm::length(turn);
    if (last || std::abs(change) < kSameTurn) break;
  }
  return turn;
}

}  // namespace tangent
