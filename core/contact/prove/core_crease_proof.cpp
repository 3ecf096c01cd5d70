#include "core/contact/prove/core_crease_proof.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {
namespace {

/// Sine of the angle by which an edge turns, and by which its normals lean along it, at most, to be taken for straight.
constexpr double kMostTurn = 0.5, kMostLean = 0.3;
constexpr int kHalvings = 3, kGlanceHalvings = 0;  // of a fan

double chord_of(double cosine) { return std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine)); }

/// The direction of an edge, and the sine of the angle by which it is off that.
struct Along {
  Vec3 axis;
  double sine;
  double chord() const { return chord_of(std::sqrt(1.0 - sine * sine)); }
};
Along along(const CreaseNet& crease) {
  const Vec3 chord = crease.curve[3] - crease.curve[0];
  if (chord == Vec3(0.0)) return {unit(glm::cross(crease.near[0], crease.far[0])), 0.0};
  const std::array<Vec3, 3> speed{crease.curve[1] - crease.curve[0], crease.curve[2] - crease.curve[1],
                                  crease.curve[3] - crease.curve[2]};
  Along a{unit(chord), 0.0};
  for (const Vec3& x : speed) {
    const Vec3 across = glm::cross(x, a.axis);
    const double x2 = glm::dot(x, x);
    if (!(glm::dot(x, chord) > 0.0)) return {a.axis, 1.0};
    a.sine = std::max(a.sine, std::sqrt(glm::dot(across, across) / x2));
  }
  return a;
}

constexpr double kPerChord = 1.03;  // the angle, of chords up to a half

/// How far p(N) moves at most while N turns by a chord of that length, |A N| no less than that all along.
double slide_within(const FingerCore& core, double least_length_m, double chord) {
  return std::min(2.0 * core.longest_m(), core.largest_radius(least_length_m) * kPerChord * chord);
}

/// The core's support for the planes with one normal of the fan, or all but that one, along the edge.
struct Pull {
  Vec3 normal;  ///< in the middle of those along the edge
  bool known = false;
  double wide = 0.0;      ///< by how much the others are off it, lean and all, as a chord
  CoreSupport support{};  ///< for that
  double aside_m = 0.0;  ///< how far it is from the middle of the edge along the turn from the near side to the far one
  double room_m = 0.0;   ///< by how much that differs elsewhere on the edge, for its normals and turns, at most
  double half_width_m = 0.0, least_length_m = 0.0;
  double height_m = 0.0;  ///< of the core over the planes, at least

  /// For normals within `off_it` of a unit one, and turns that lean by `turn_leans`.
  Pull(const FingerCore& core, const Vec3& middle_normal, double off_it, double turn_leans, const SurfaceBounds& bounds,
       const Along& edge)
      : normal(middle_normal), wide(off_it) {
    const Vec3 out = glm::cross(edge.axis, normal);
    const double length = std::sqrt(glm::dot(out, out));
    known = wide < kMostWide && length > 0.5;
    if (!known) return;
    const Vec3 t = out / length;
    support = core.support(normal);
    const Vec3 away = support.point - bounds.middle;
    aside_m = glm::dot(away, t);
    height_m = glm::dot(away, normal) - glm::dot(bounds.half, glm::abs(normal));
    room_m = glm::dot(bounds.half, glm::abs(t));
    half_width_m = core.half_width(t);
    least_length_m = support.length;
    const double off = 2.0 * (wide + edge.chord()) / (length + 0.9) + turn_leans;
    if (!(off > 0.0)) return;
    least_length_m -= core.longest_m() * wide;
    half_width_m = core.longest_m();
    const double moves = slide_within(core, least_length_m, wide), farthest = std::sqrt(glm::dot(away, away));
    room_m += moves + off * (farthest + bounds.radius_m + moves);
    height_m -= wide * (farthest + bounds.radius_m + moves);  // that for other planes lies lower over them
  }

  /// How far the finger may go until a contact could come up with a normal from here on to `last`, the other end of a
  /// range of the fan; `sign` -1: the far one.
  double margin(const FingerCore& core, double sign, const Pull& last, double lean_rad) const {
    if (!known) return 0.0;
    const double cosine =
        std::min(1.0, glm::dot(normal, last.normal)) - kPerChord * (wide + last.wide + 2.0 * lean_rad);
    if (!(cosine > kLeastCosine)) return 0.0;
    const double tangent = std::sqrt(1.0 - cosine * cosine) / cosine;
    const double room = sign * aside_m - room_m + std::min(0.0, height_m) * tangent;
    if (!(room > 0.0)) return 0.0;
    const double share = room / (1.0 + tangent);  // the height changes by no more than the way
    return std::min(share, core.way_within(half_width_m, least_length_m, share));
  }

 private:
  static constexpr double kLeastCosine = 0.1, kMostWide = 0.5;
};

/// How far the finger may go until the supports for the normals between two could lie over the edge, beside which they
/// lie now. While N runs over an arc, g (finger_core.h) does, and along the edge the supports lie off the centre by -(A
/// T).g, a sinusoid.
double margin_along(const FingerCore& core, const CreaseNet& crease, const SurfaceBounds& bounds, const Along& edge,
                    double wide, const Pull& first, const Pull& last) {
  if (!first.known || !last.known) return 0.0;
  const Vec3 v = core.scaled(edge.axis), &g = first.support.direction, &h = last.support.direction;
  const double a = glm::dot(v, g), b = glm::dot(v, h), c = glm::dot(g, h), sine2 = 1.0 - c * c;
  double low = std::min(a, b), high = std::max(a, b);
  if (sine2 > 1e-12 && (b - c * a) * (a - c * b) > 0.0) {  // it turns in between
    const double most = std::sqrt(std::max(0.0, (a * a + b * b - 2.0 * a * b * c) / sine2));
    (b > c * a ? high : low) = b > c * a ? std::max(high, most) : std::min(low, -most);
  }
  // |A N| over the arc, by the chord, which lies within the unit sphere.
  const Vec3 from = first.support.length * g, way = last.support.length * h - from;
  const double way2 = glm::dot(way, way), at = way2 > 0.0 ? std::clamp(-glm::dot(from, way) / way2, 0.0, 1.0) : 0.0;
  const Vec3 nearest = from + at * way;
  const double least_length = std::sqrt(glm::dot(nearest, nearest)) - core.longest_m() * wide;
  const double along = glm::dot(core.centre() - bounds.middle, edge.axis);
  const Vec3 to_core = core.centre() - bounds.middle;
  double room = glm::dot(bounds.half, glm::abs(edge.axis));
  if (wide > 0.0) room += slide_within(core, least_length, wide);
  const double leans = crease.lean + edge.chord();
  if (leans > 0.0) room += leans * (std::sqrt(glm::dot(to_core, to_core)) + core.longest_m() + bounds.radius_m);
  const double miss = std::max(along - high, low - along) - room;
  return core.way_within(core.half_width(edge.axis), least_length, miss);
}

/// The margin of a crease, whose fan is halved while nothing is known of a range.
class FanRanges {
 public:
  FanRanges(const FingerCore& core, const CreaseNet& crease, const Along& edge, double enough_m)
      : core_(core),
        crease_(crease),
        edge_(edge),
        bounds_(crease.box().centre(), 0.5 * crease.box().size(), {}),
        enough_m_(enough_m) {}

  double margin(int halvings) {
    near_ = side_of(crease_.near);
    far_ = side_of(crease_.far);
    const PullAt near = pull_at({1.0, 0.0}), far = pull_at({0.0, 1.0});
    return margin(near, far, halvings);
  }
  int tests() const { return tests_; }

 private:
  static constexpr int kMostTests = 24;
  /// A range excluded for less is not halved for more.
  static constexpr double kShare = 0.1;
  static constexpr double kLeastSum = 0.1;  // of two normals: no angle between them is wider

  /// The normals of one side of the crease: their middle one, and by how much the others are off it.
  struct Side {
    Vec3 normal;
    double wide = 0.0;
  };
  static Side side_of(const std::array<Vec3, 3>& n) {
    const bool even = n[0] == n[1] && n[1] == n[2] && n[0] != Vec3(0.0);
    if (even) return {unit(n[0]), 0.0};
    const NormalCone cone = cone_of(n);
    return {cone.axis, chord_of(cone.cos_half)};
  }
  /// For the normals that are so much of the near side's and of the far one's, a unit vector in the middle.
  struct PullAt {
    Vec2 of;
    Pull pull;
  };
  PullAt pull_at(const Vec2& of) {
    ++tests_;
    const double leans = of.x > 0.0 && of.y > 0.0 ? crease_.lean_rad : 0.0;
    return {of,
            {core_, of.x * near_.normal + of.y * far_.normal, of.x * near_.wide + of.y * far_.wide + leans,
             crease_.lean_turn, bounds_, edge_}};
  }
  double margin(const PullAt& from, const PullAt& to, int halvings) {
    const Pull &first = from.pull, &last = to.pull;
    const double drawn =
        std::max(first.margin(core_, -1.0, last, crease_.lean_rad), last.margin(core_, 1.0, first, crease_.lean_rad));
    if (is_enough(drawn)) return drawn;
    const Vec3 sum = first.normal + last.normal;
    const double length = std::sqrt(glm::dot(sum, sum));
    if (!(length > kLeastSum)) return drawn;
    // Of those in between, of either more, up to that over the cosine of half their angle.
    const double wide = 2.0 * std::max(first.wide, last.wide) / length + crease_.lean_rad;
    const double margin_here = std::max(drawn, margin_along(core_, crease_, bounds_, edge_, wide, first, last));
    if (is_enough(margin_here) || halvings == 0 || tests_ >= kMostTests) return margin_here;
    const PullAt middle = pull_at((from.of + to.of) / length);
    // The likelier half first.
    const bool far = middle.pull.aside_m > 0.0;
    const auto half = [&](bool second) {
      return second ? margin(middle, to, halvings - 1) : margin(from, middle, halvings - 1);
    };
    const double one = half(far);
    return one > margin_here ? std::max(margin_here, std::min(one, half(!far))) : margin_here;
  }
  bool is_enough(double margin) const { return margin > 0.0 && margin >= kShare * enough_m_; }

  const FingerCore& core_;
  const CreaseNet& crease_;
  const Along& edge_;
  const SurfaceBounds bounds_;
  double enough_m_;
  Side near_, far_;
  int tests_ = 0;
};

}  // namespace

// At a contact with normal N the whole core lies over N's plane through p(N) = S + lambda N. Take another normal n of
// the fan, at an angle a below a right one, with e the direction of the turn from n to N and p the core's support for
// n, at a height h over n's plane through S. No point of the core lies lower along n: h <= lambda cos a. And p lies
// over the contact's plane: h cos a + (p - S).e sin a >= lambda. So (p - S).e >= h tan a; where it is less, to the near
// side, and below 0, there is no contact from n on to N. That halves the fan until what is left are turns that may have
// one, of which the place along the edge tells.
double crease_margin(const FingerCore& core, const CreaseNet& crease, double enough_m, bool glance, int& tests) {
  const Along edge = along(crease);
  if (!(edge.sine < kMostTurn) || !(crease.lean < kMostLean)) return 0.0;
  FanRanges ranges(core, crease, edge, enough_m);
  const double margin = ranges.margin(glance ? kGlanceHalvings : kHalvings);
  tests += ranges.tests();
  return margin;
}

}  // namespace tangent
