// The fan of normals about a point of a crease or boundary edge.
//
// A direction across the edge is a unit vector (cos, sin) of the angle by which it is turned about the edge from the
// near side's normal towards the far side's: solving on an edge takes no angle, sine or arc tangent.
#pragma once

#include "core/finger/finger.h"
#include "core/surface/patch_edge.h"

#include <algorithm>
#include <cmath>

namespace tangent {

/// The frame of a crease or boundary edge at one point of it. e1 and e2 are kept also as they are before they are
/// divided by their lengths: what is made of those needn't wait for the roots and divisions, which take longest.
struct EdgeFan {
  Vec3 point, point_f;      ///< on the edge curve; derivative along f
  Vec3 tangent, tangent_f;  ///< unit; its derivative along f
  Vec3 e1, e2;              ///< perpendicular to the tangent; e1 along the near side's normal, e2 away from its face
  Vec3 across, beyond;      ///< along e1 and e2, of some length: |beyond| = |across|/per_along
  double per_along = 0.0;   ///< 1 by the length of what `tangent` was made of
  Vec3 near_normal, far_normal;            ///< unit normals of the two sides
  Vec3 near_normal_f, far_normal_f;        ///< their derivatives along f
  double tilt_near = 0.0, tilt_far = 0.0;  ///< normal . tangent on the two sides
  Vec2 far{1.0, 0.0};                      ///< the far normal's direction in (e1, e2); (-1, 0) at a boundary
  bool even =
      false;  ///< tilt and derivative along f are the same all over the fan; else they change with share_of the turn
  double cot_half =
      0.0;  ///< cotangent of half the angle from the near normal to the far one; 0 where that is half a circle
  bool uniform = false;      ///< of a straight edge between flat sides: the same all along but for the point, normals
                             ///< perpendicular to it
  Vec3 start;                ///< the point at f = 0, where `uniform`
  double per_length2 = 0.0;  ///< 1/|point_f|^2, 1/m^2, where `uniform`

  /// Whether the normals part: only such an edge can be touched.
  bool convex() const { return far.y > 0.0 || (far.y == 0.0 && far.x < 0.0); }
};

inline constexpr Vec2 kNearTurn{1.0, 0.0};

/// Whether a plane with this turn lies between those of the two sides.
inline bool in_fan(const EdgeFan& fan, const Vec2& turn) {
  return fan.convex() && turn.y >= 0.0 && turn.x * fan.far.y >= turn.y * fan.far.x;
}
/// The turn itself, or that of the side it is nearer to.
Vec2 clamp_turn(const EdgeFan& fan, const Vec2& turn);

/// How far a turn is from the near side (0) to the far one (1): (sin(t - a/2) / sin(a/2) + 1) / 2, with t the turn's
/// angle and a the fan's, which rises with t in fans of up to half a circle. Needs no angle: with x = cos t, y = sin t.
inline double share_of(const EdgeFan& fan, const Vec2& turn) { return 0.5 * ((1.0 - turn.x) + turn.y * fan.cot_half); }
/// Its derivative by the turn's angle.
inline double share_rate(const EdgeFan& fan, const Vec2& turn) { return 0.5 * (turn.y + turn.x * fan.cot_half); }

// Of uniform fans, which take no iteration: the nearest point of the edge's line, and the direction from there.

/// From a point of the edge to the foot of the perpendicular from a centre that is `d` from it, along f.
inline double uniform_step(const EdgeFan& fan, const Vec3& d) { return glm::dot(d, fan.point_f) * fan.per_length2; }
inline Vec3 uniform_point(const EdgeFan& fan, double f) { return fan.start + f * fan.point_f; }
inline Vec3 uniform_normal(const EdgeFan& fan, const Vec2& turn) { return turn.x * fan.e1 + turn.y * fan.e2; }
/// edge_sample there.
inline void uniform_sample(const EdgeFan& fan, const Vec3& point, const Vec2& turn, const Vec3& normal,
                           SurfaceSample& sample) {
  sample.point = point;
  sample.point_u = fan.point_f;
  sample.point_v = sample.normal_u = Vec3(0.0);
  sample.normal = normal;
  sample.normal_v = turn.x * fan.e2 - turn.y * fan.e1;
}

/// How far the normals at a turn lean along the edge.
struct FanTilt {
  double share = 0.0;             ///< of the far side
  double tilt = 0.0, rate = 0.0;  ///< normal . tangent, and its derivative by the turn's angle
  double level = 1.0;             ///< the normal's part across the edge
};
[[gnu::always_inline]] inline FanTilt tilt_at(const EdgeFan& fan, const Vec2& turn) {
  FanTilt at;
  if (!fan.even) {
    at.share = std::clamp(share_of(fan, turn), 0.0, 1.0);
    at.rate = (fan.tilt_far - fan.tilt_near) * share_rate(fan, turn);
  }
  at.tilt = fan.tilt_near + at.share * (fan.tilt_far - fan.tilt_near);
  at.level = std::sqrt(std::max(0.0, 1.0 - at.tilt * at.tilt));
  return at;
}

/// The edge's point with the fan's unit normal at `turn`; _u is along f, _v along the turn's angle. The normal's
/// derivative along f is interpolated between the sides, but for its part along the edge, N_f.T = tilt_f - N.T_f, which
/// is exact. Inline, lest the solver waits for what it has just written to be read back.
[[gnu::always_inline]] inline void edge_sample(const EdgeFan& fan, Vec2 turn, SurfaceSample& sample) {
  if (fan.uniform) return uniform_sample(fan, fan.point, turn, uniform_normal(fan, turn), sample);
  const auto [share, tilt, tilt_rate, level] = tilt_at(fan, turn);
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

/// A direction in (e1, e2), of any length.
struct TurnTriangle {
  double x, y, length;
};
/// Of a direction's part across the edge, times |across|.
inline TurnTriangle turn_triangle(const EdgeFan& fan, const Vec3& direction) {
  const double x = glm::dot(direction, fan.across), y = glm::dot(direction, fan.beyond) * fan.per_along;
  return {x, y, std::sqrt(x * x + y * y)};
}
/// The unit vector along it; kNearTurn where it has no direction.
inline Vec2 unit_turn(const TurnTriangle& turn) {
  return turn.length > 0.0 ? Vec2(turn.x / turn.length, turn.y / turn.length) : kNearTurn;
}
/// The turn of a direction, not limited to the fan.
inline Vec2 turn_of(const EdgeFan& fan, const Vec3& direction) { return unit_turn(turn_triangle(fan, direction)); }
/// The turn at which the plane faces the finger: the travel has no component across the edge. Not limited to the fan.
Vec2 facing_turn(const EdgeFan& fan, const Finger& finger, const FingerPose& pose);

/// What the fans of a crease or boundary edge are made of; the cache keeps it.
struct FanEdge {
  EdgeCurve curve;
  EdgeNormals near, far;  ///< far: the neighbour's, with f counted as on this side
  Vec3 chord, inwards;    ///< from the first corner to the second, and to the near triangle's third
  double chord2 = 0.0;    ///< |chord|^2
  bool boundary = false;
  bool flat_near = false, flat_far = false;  ///< constant normals along that side
  bool straight = false;                     ///< a straight edge between such sides: the same fan all along
};
/// Completes an edge of which curve, normals, chord, inwards and boundary are given, and where it is straight sets
/// `fan` but for its point.
void prepare_fan(FanEdge& edge, EdgeFan& fan);
/// Brings `fan` to fraction f of its edge.
void move_fan(const FanEdge& edge, double f, EdgeFan& fan);

}  // namespace tangent
