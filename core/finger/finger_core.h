// The finger as a ball rolled over an ellipsoid, its core: what proofs need to know of fingers that are not round.
//
// The core of a point or sphere is its centre, that of an ellipsoid the ellipsoid, that of a capsule its spindle. A
// plane of normal N is touched by the ball about p(N), the core's point furthest along -N. So a contact is where p(N) -
// S runs along N, as for a sphere with its centre at p(N); p depends on N as A does on the unit sphere: with A the
// core's axes, p(N) = c - A g, g the unit vector of y = A N.
//
// Bounds: along a step tau across N, p(N + tau) - p(N) = D tau + r with D = -A (I - g g^T) A / |y| and
// |r.t| <= |A t| |A tau|^2 / (sqrt(3) |y|^2), |y| at its least, since the second derivative of g is 2/sqrt(3) |v|^2 /
// |y|^2 at most. The largest radius of curvature is the largest eigenvalue of -D: no more than a^2 / |y|, nor (a b)^2 /
// |y|^3, a and b the longest axes.
#pragma once

#include "core/finger/finger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace tangent {

/// Of a normal: the core's point furthest along -N, and what its neighbourhood follows from.
struct CoreSupport {
  Vec3 point;           ///< p(N), in the frame of the pose
  Vec3 direction;       ///< g, unit, finger frame
  double length = 0.0;  ///< |A N|, m: the core's support function
};

/// Normals within an angle of a unit axis.
struct NormalCone {
  Vec3 axis{0.0, 0.0, 1.0};
  double cos_half = -1.0;  ///< -1: every direction
};

/// The cone of the directions of some vectors, and of all sums of them, about their own sum.
NormalCone cone_of(std::span<const Vec3> normals);

/// A part of the surface by bounds: its points in a box, its normals in a cone.
struct SurfaceBounds {
  Vec3 middle, half;  ///< of the box, m
  NormalCone normals;
  double radius_m, sine;  ///< of the ball about the box; of the cone's half angle

  SurfaceBounds(const Vec3& box_middle, const Vec3& box_half, const NormalCone& cone)
      : middle(box_middle),
        half(box_half),
        normals(cone),
        radius_m(std::sqrt(glm::dot(half, half))),
        sine(std::sqrt(std::max(0.0, 1.0 - cone.cos_half * cone.cos_half))) {}
};

class FingerCore {
 public:
  /// `turns`: whether it may turn on its way; otherwise it goes straight.
  FingerCore(const Finger& finger, const FingerPose& pose, bool turns = true);

  /// Without turning.
  void move_to(const Vec3& centre) { centre_ = centre; }

  double ball_m() const { return ball_m_; }
  /// How fast the depth of any plane changes while the finger turns, m per rad at most: the unroundness.
  double lever_m() const { return lever_m_; }
  double reach_m() const { return reach_m_; }
  /// Radii of curvature of the whole finger, over all its places and directions.
  double flattest_m() const { return ball_m_ + largest_radius(0.0); }
  double sharpest_m() const { return ball_m_ + sharpest_m_; }
  /// flattest_near of any cone is no less.
  double least_flattest_m() const { return ball_m_ + largest_radius(longest_m_); }
  /// The largest at normals within a cone, while the finger goes `way_m`.
  double flattest_near(const NormalCone& normals, double way_m) const;

  CoreSupport support(const Vec3& normal) const {
    const Vec3 y = scaled(normal);
    CoreSupport s;
    s.length = std::sqrt(glm::dot(y, y));
    s.direction = s.length > 0.0 ? y / s.length : Vec3(0.0);
    s.point = centre_ - rotation_ * (axes_m_ * s.direction);
    return s;
  }
  /// A t, in the finger's frame.
  Vec3 scaled(const Vec3& t) const { return axes_m_ * (t * rotation_); }
  /// D t at a support.
  Vec3 derivative(const CoreSupport& support, const Vec3& t) const { return derivative_of(support, scaled(t)); }
  /// The same of t that is scaled already, and its length.
  Vec3 derivative_of(const CoreSupport& s, const Vec3& scaled_t) const {
    return s.length > 0.0 ? rotation_ * derivative_in_finger(s, scaled_t) / s.length : Vec3(0.0);
  }
  double derivative_length(const CoreSupport& s, const Vec3& scaled_t) const {
    const Vec3 d = derivative_in_finger(s, scaled_t);
    return s.length > 0.0 ? std::sqrt(glm::dot(d, d)) / s.length : 0.0;
  }
  /// |A tau| at most for steps across the support's normal of length `tangent`.
  double widest_step(const CoreSupport& support, double tangent) const;
  /// |r.t| / |A t| at most for such steps with |A tau| up to `step_m`; infinite where nothing is known.
  double bend(const CoreSupport& support, double step_m) const;
  /// Half the core's width along a unit direction, m.
  double half_width(const Vec3& t) const {
    const Vec3 at = scaled(t);
    return std::sqrt(glm::dot(at, at));
  }
  /// The core's largest radius of curvature at normals whose |A N| is at least this, m.
  double largest_radius(double least_length_m) const;
  /// |A N| at least after the finger has gone `way_m`, where it is this now.
  double length_after(double least_length_m, double way_m) const {
    return least_length_m - longest_m_ * turn_within(way_m);
  }
  double longest_m() const { return longest_m_; }
  const Vec3& axes_m() const { return axes_m_; }
  const Mat3& rotation() const { return rotation_; }  ///< from the frame of the axes to the pose's
  double width_m() const { return middle_m_; }        ///< the second longest axis
  /// By how much it may turn on a way, rad.
  double turn_within(double way_m) const { return turns_ ? way_m / reach_m_ : 0.0; }
  const Vec3& centre() const { return centre_; }
  /// Unit, along the core's longest axis.
  const Vec3& long_axis() const { return long_axis_; }

  /// How far a box lies outside the whole finger, at least; not over 0: it may reach into it.
  double apart_m(const Vec3& middle, const Vec3& half) const;
  /// Radius of the ball about the centre that is the finger's at any rate.
  double inner_m() const { return ball_m_ + shortest_m_; }
  /// The least rank (contact_rank.h) of contacts at places so far outside the whole finger. Either the plane lies
  /// outside it, too, or the place is beyond it, seen from where it touches the plane: then the contact is as deep as
  /// the finger is thick there, and more, so that the centre is behind the plane.
  double rank_outside(double apart_m) const {
    return apart_m > over_m_ ? reach_m_ + (apart_m - over_m_) : -std::numeric_limits<double>::infinity();
  }
  /// How far outside a place has to be for that rank, and to have one at all after the finger has gone `way_m`.
  double outside_at(double rank_m, double way_m) const { return over_m_ + std::max(way_m, rank_m - reach_m_); }

  /// The least rank (contact_rank.h) of contacts with a normal within a cone: a finger whose centre is before the plane
  /// is no deeper than its support there, and where it is behind the contact ranks after its reach.
  double least_rank(const NormalCone& normals) const;
  /// How far the place of a contact of a rank up to this can be from the centre.
  double farthest_m(double rank_m) const;
  /// Below it every plane that is touched from before is shallower than the finger: least_rank tells something.
  double deep_rank_m() const { return lever_m_; }

  /// How far p(N) can move along a direction across N while the finger goes `way_m`: its centre's way and the reach
  /// times its turning, as gone_m counts. `half_width_m`: of the core in that direction; `least_length_m`: |A N| at
  /// least, now.
  double slide_m(double half_width_m, double least_length_m, double way_m) const;
  /// How far the finger may go until slide_m reaches `room_m`, at least.
  double way_within(double half_width_m, double least_length_m, double room_m) const;

 private:
  Vec3 derivative_in_finger(const CoreSupport& s, const Vec3& scaled_t) const {
    return axes_m_ * (glm::dot(s.direction, scaled_t) * s.direction - scaled_t);
  }
  double slide_rate(double least_length_m, double way_m) const;

  Vec3 centre_, axes_m_, long_axis_;
  Mat3 rotation_;
  bool turns_ = true;
  double ball_m_ = 0.0, lever_m_ = 0.0, reach_m_ = 0.0;
  double longest_m_ = 0.0, middle_m_ = 0.0, shortest_m_ = 0.0, sharpest_m_ = 0.0;
  double flattest_core_m_ = 0.0;
  /// By how much the support function H, the depth of a plane through the centre, exceeds at most the finger's
  /// thickness along the plane's normal where it touches it.
  double over_m_ = 0.0;
  double squares_m2_ = 0.0;  ///< sum of the squared axes
  double pair2_m4_ = 0.0;    ///< square of the product of the two longest
  /// The slide rate at normals whose |A N| is above slow_length_m_; the finger goes slow_turn_ times what is above that
  /// until its turning has used it up.
  double least_rate_ = 1.0, slow_length_m_ = 0.0, slow_turn_ = 0.0;
};

/// Whether the core is all but a segment, as a capsule's.
inline bool is_thin(const FingerCore& core) {
  constexpr double kThin = 0.05;  // half width to half length
  return core.width_m() < kThin * core.longest_m();
}

/// Whether the centre is behind every plane of a part by that far.
bool is_behind(const FingerCore& core, const SurfaceBounds& part, double by_m);
/// How far it is behind all of them, at least; not over 0: nothing is known.
double behind_m(const FingerCore& core, const SurfaceBounds& part);
/// Whether no finger within `way_m` touches such a part, at the first glance: all lines along its normals pass by.
bool is_beside(const FingerCore& core, const SurfaceBounds& part, double way_m);
/// Which contacts a finger may have on such a part: p(N) - S = lambda N with lambda up to `most_m`, which is the ball's
/// radius less the depth.
bool can_touch(const FingerCore& core, const SurfaceBounds& part, double most_m, double way_m);
/// The same without what single directions tell.
bool can_touch_at_a_glance(const FingerCore& core, const SurfaceBounds& part, double way_m);
/// How far the finger may go until it could touch such a part at all; 0: no proof. Once it is `enough_m`, no more is
/// asked for.
double touch_margin(const FingerCore& core, const SurfaceBounds& part,
                    double enough_m = std::numeric_limits<double>::infinity());

}  // namespace tangent
