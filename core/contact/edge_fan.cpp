#include "core/contact/edge_fan.h"

#include "core/base/tolerances.h"
#include "core/contact/plane_contact.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

Vec3 any_perpendicular(const Vec3& n) {
  const Vec3 axis = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : std::abs(n.y) < 0.6 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  return unit(glm::cross(n, axis));
}

bool constant(const EdgeNormals& n) {
  return glm::distance(n.normals[1], n.normals[0]) <= kStraightEdge && glm::distance(n.normals[2], n.normals[0]) <= kStraightEdge;
}

bool is_straight(const FanEdge& edge) {
  const auto& p = edge.curve.offsets;
  const double room = kStraightEdge * glm::length(edge.chord);
  return glm::distance(3.0 * (p[1] - p[0]), edge.chord) <= room && glm::distance(3.0 * (p[3] - p[2]), edge.chord) <= room &&
         edge.flat_near && (edge.boundary || edge.flat_far);
}

/// Where all coefficients of a side's normals are the same, there is nothing to evaluate.
EdgeNormal side_normal(const EdgeNormals& side, bool flat, double f) {
  return flat ? EdgeNormal{side.normals[0], Vec3(0.0)} : evaluate(side, f);
}

/// The curve's point and tangent and the near side's normal, with the frame that they span.
void set_near_side(const FanEdge& edge, double f, EdgeFan& fan) {
  const EdgePoint at = evaluate(edge.curve, f);
  const EdgeNormal near = side_normal(edge.near, edge.flat_near, f);
  const double speed2 = glm::dot(at.point_f, at.point_f), chord2 = glm::dot(edge.chord, edge.chord);
  const bool moves = speed2 > 1e-12 * chord2;
  const Vec3 along = moves ? at.point_f : edge.chord;
  const double along2 = moves ? speed2 : chord2;
  fan.point = at.point;
  fan.point_f = at.point_f;
  fan.tangent = unit(along);
  fan.tangent_f = speed2 > 0.0 ? (at.point_ff - glm::dot(at.point_ff, fan.tangent) * fan.tangent) / std::sqrt(speed2) : Vec3(0.0);
  fan.near_normal = near.normal;
  fan.near_normal_f = near.normal_f;
  fan.tilt_near = std::clamp(glm::dot(near.normal, fan.tangent), -1.0, 1.0);
  // From `along` as it is: two roots and two divisions, which take longest, go on beside each other.
  const Vec3 across = along2 * near.normal - glm::dot(near.normal, along) * along;
  fan.e1 = glm::dot(across, across) > 1e-12 * along2 * along2 ? unit(across) : any_perpendicular(fan.tangent);
  fan.e2 = glm::cross(fan.tangent, fan.e1);
  if (glm::dot(fan.e2, edge.inwards) > 0.0) fan.e2 = -fan.e2;
}

/// The other side's normal; a boundary lets the normal turn from the face's front to its back.
void set_far_side(const FanEdge& edge, double f, EdgeFan& fan) {
  if (edge.boundary) {
    fan.far_normal = fan.near_normal;
    fan.far_normal_f = fan.near_normal_f;
    fan.tilt_far = fan.tilt_near;
    fan.far = {-1.0, 0.0};
    fan.cot_half = 0.0;
    return;
  }
  const EdgeNormal far = side_normal(edge.far, edge.flat_far, 1.0 - f);
  fan.far_normal = far.normal;
  fan.far_normal_f = -far.normal_f;
  fan.tilt_far = std::clamp(glm::dot(far.normal, fan.tangent), -1.0, 1.0);
  const double x = glm::dot(far.normal, fan.e1), y = glm::dot(far.normal, fan.e2), length = std::sqrt(x * x + y * y);
  fan.far = length > 0.0 ? Vec2(x / length, y / length) : kNearTurn;
  fan.cot_half = y != 0.0 ? (length + x) / y : 0.0;  // half a circle: 0
}

/// Without what rounding leaves of bends and leanings along a straight edge.
void straighten(const FanEdge& edge, EdgeFan& fan) {
  fan.point_f = edge.chord;
  fan.tangent_f = fan.near_normal_f = fan.far_normal_f = Vec3(0.0);
  if (std::abs(fan.tilt_far - fan.tilt_near) <= 2.0 * kStraightEdge) fan.tilt_far = fan.tilt_near;
  if (std::abs(fan.tilt_near) <= 2.0 * kStraightEdge && fan.tilt_far == fan.tilt_near) fan.tilt_near = fan.tilt_far = 0.0;
}

void set_fan(const FanEdge& edge, double f, EdgeFan& fan) {
  set_near_side(edge, f, fan);
  set_far_side(edge, f, fan);
  if (edge.straight) straighten(edge, fan);
  fan.even = fan.tilt_near == fan.tilt_far && fan.near_normal_f == fan.far_normal_f &&
             (fan.tangent_f == Vec3(0.0) || fan.near_normal == fan.far_normal);
  fan.uniform = edge.straight && fan.tilt_near == 0.0 && fan.tilt_far == 0.0;
  if (!fan.uniform) return;
  fan.start = edge.curve.origin + edge.curve.offsets[0];
  fan.per_length2 = 1.0 / glm::dot(fan.point_f, fan.point_f);
}

}  // namespace

void prepare_fan(FanEdge& edge, EdgeFan& fan) {
  edge.flat_near = constant(edge.near);
  edge.flat_far = !edge.boundary && constant(edge.far);
  edge.straight = is_straight(edge);
  if (edge.straight) set_fan(edge, 0.0, fan);
}

void move_fan(const FanEdge& edge, double f, EdgeFan& fan) {
  if (!edge.straight) {
    set_fan(edge, f, fan);
  } else if (fan.uniform) {
    fan.point = uniform_point(fan, f);
  } else {
    fan.point = edge.curve.origin + (edge.curve.offsets[0] + f * edge.chord);
  }
}

Vec2 clamp_turn(const EdgeFan& fan, const Vec2& turn) {
  if (in_fan(fan, turn)) return turn;
  return fan.convex() && glm::dot(turn, fan.far) > turn.x ? fan.far : kNearTurn;
}

void edge_sample(const EdgeFan& fan, Vec2 turn, SurfaceSample& sample) {
  if (fan.uniform) return uniform_sample(fan, fan.point, turn, uniform_normal(fan, turn), sample);
  double share = 0.0, tilt_rate = 0.0;  // of the far side; of the tilt, 1/rad
  if (!fan.even) {
    share = std::clamp(share_of(fan, turn), 0.0, 1.0);
    tilt_rate = (fan.tilt_far - fan.tilt_near) * share_rate(fan, turn);
  }
  const double tilt = fan.tilt_near + share * (fan.tilt_far - fan.tilt_near);
  const double level = std::sqrt(std::max(0.0, 1.0 - tilt * tilt));
  const Vec3 radial = turn.x * fan.e1 + turn.y * fan.e2;
  const Vec3 normal = tilt * fan.tangent + level * radial;
  Vec3 by_turn = level * (turn.x * fan.e2 - turn.y * fan.e1);
  if (tilt_rate != 0.0 && level > 1e-9) by_turn += tilt_rate * (fan.tangent - (tilt / level) * radial);
  const Vec3 between = (1.0 - share) * fan.near_normal + share * fan.far_normal;
  const Vec3 by_f = (1.0 - share) * fan.near_normal_f + share * fan.far_normal_f +
                    glm::dot(between - normal, fan.tangent_f) * fan.tangent;
  sample.point = fan.point;
  sample.point_u = fan.point_f;
  sample.point_v = Vec3(0.0);
  sample.normal = normal;
  sample.normal_u = by_f - glm::dot(by_f, normal) * normal;
  sample.normal_v = by_turn;
}

Vec2 facing_turn(const EdgeFan& fan, const Finger& finger, const FingerPose& pose) {
  Vec2 turn = turn_of(fan, pose.position - fan.point);
  if (is_round(finger)) return turn;
  // Other shapes: Newton on the component of the travel across the edge, d(travel)/d(turn) = -H dN/d(turn).
  for (int i = 0; i < 20; ++i) {
    SurfaceSample s;
    edge_sample(fan, turn, s);
    const PlaneContact c = contact_on_plane(finger, pose, s.point, s.normal);
    const Vec3 across = unit(glm::cross(fan.tangent, s.normal));
    const double residual = glm::dot(c.travel, across);
    const double slope = glm::dot(offset_derivative(finger, pose, s.normal, c.penetration_m) * s.normal_v, across);
    if (!(std::abs(slope) > 0.0)) break;
    const double change = std::clamp(residual / slope, -0.5, 0.5), c1 = std::cos(change), s1 = std::sin(change);
    turn = unit_turn(c1 * turn.x - s1 * turn.y, s1 * turn.x + c1 * turn.y);
    if (std::abs(change) < 1e-13) break;
  }
  return turn;
}

}  // namespace tangent
