#include "core/finger/finger_core.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace tangent {
namespace {

constexpr double kWideCone = 0.7;     // cosine: of wider cones nothing is proved along single directions ...
constexpr double kWidestCone = 0.05;  // ... or at all

/// The support of a part's axis, seen from the part's middle.
struct Sight {
  CoreSupport support;
  Vec3 away{0.0};                   ///< from the part's middle to the support
  double away2 = 0.0, along = 0.0;  ///< |away|^2, away along the axis

  Sight(const FingerCore& core, const SurfaceBounds& part)
      : support(core.support(part.normals.axis)),
        away(support.point - part.middle),
        away2(glm::dot(away, away)),
        along(glm::dot(away, part.normals.axis)) {}

  /// Then no direction tells more.
  bool is_near(const SurfaceBounds& part) const { return away2 < part.radius_m * part.radius_m; }
};

/// What a cone of normals does to it.
struct Spread {
  double tangent = 0.0;  ///< of the half angle
  double step_m = 0.0;   ///< |A tau| at most
  double least_length_m = 0.0;
  double bend = 0.0;      ///< of the core, FingerCore::bend; set by bound_curving
  double lambda_m = 0.0;  ///< |p(N) - S| at most; set by bound_curving
};

Spread spread_over(const FingerCore& core, const SurfaceBounds& part, const Sight& sight) {
  Spread s;
  s.tangent = part.sine / part.normals.cos_half;
  s.step_m = core.widest_step(sight.support, s.tangent);
  s.least_length_m = sight.support.length - s.step_m;
  return s;
}

/// What only misses along single directions need.
void bound_curving(const FingerCore& core, const SurfaceBounds& part, const Sight& sight, Spread& s) {
  s.bend = core.bend(sight.support, s.step_m);
  const double moves = core.largest_radius(sight.support.length) * s.tangent + core.longest_m() * s.bend;
  s.lambda_m = std::sqrt(sight.away2) + part.radius_m + std::min(2.0 * core.longest_m(), moves);
}

double extent(const Vec3& half, const Vec3& t) { return glm::dot(half, glm::abs(t)); }

/// How far p(N).t can be from that of the cone's axis.
double spread_along(const FingerCore& core, const Sight& sight, const Spread& s, const Vec3& t) {
  const Vec3 scaled = core.scaled(t);
  const double half_width = std::sqrt(glm::dot(scaled, scaled));
  const double near = core.derivative_length(sight.support, scaled) * s.tangent + half_width * s.bend;
  return std::min(near, half_width + std::abs(glm::dot(sight.support.point - core.centre(), t)));
}

/// By how much p(N) - S misses the direction of N along t, a unit vector across the cone's axis, for every N and S.
/// Where the core's spread is left out of account already, that: not over 0.
double miss_along(const FingerCore& core, const SurfaceBounds& part, const Sight& sight, const Spread& s,
                  const Vec3& t) {
  const double unspread = std::abs(glm::dot(sight.away, t)) - extent(part.half, t) - part.sine * s.lambda_m;
  return unspread > 0.0 ? unspread - spread_along(core, sight, s, t) : unspread;
}

/// By how much p(N) - S misses the directions of the cone whatever its parts are: seen from the middle p(N) is within a
/// ball about that of the axis. Of wide cones that says more than a miss along one direction, of narrow ones less.
double miss_of_cone(const FingerCore& core, const SurfaceBounds& part, const Sight& sight) {
  const double cosine = part.normals.cos_half;
  const double across = std::sqrt(std::max(0.0, sight.away2 - sight.along * sight.along));
  const double unspread = across * cosine - std::abs(sight.along) * part.sine;
  if (unspread <= part.radius_m) return 0.0;  // within the cone
  const double chord = std::sqrt(2.0 - 2.0 * cosine);
  const double way = 1.12 * chord;  // over the sphere of normals, up to a right angle
  const double radius = core.largest_radius(sight.support.length - core.longest_m() * chord);
  return unspread - std::min(2.0 * core.longest_m(), radius * way) - part.radius_m;
}

bool is_missed_by_cone(const FingerCore& core, const SurfaceBounds& part, const Sight& sight, double way_m) {
  const double missed = miss_of_cone(core, part, sight);
  if (!(missed > way_m)) return false;  // no slide is shorter
  const double least_length = spread_over(core, part, sight).least_length_m;
  return missed > core.slide_m(core.longest_m(), least_length, way_m);
}

/// By how far the finger's centre misses every line through the part along its normals, beyond what one that touches
/// there may: it touches p(N) = c - q with q no further from N's line than the lever, however it is turned.
double miss_of_centre(const FingerCore& core, const SurfaceBounds& part) {
  const double cosine = part.normals.cos_half;
  const Vec3 d = core.centre() - part.middle;
  const double along = std::abs(glm::dot(d, part.normals.axis));
  const double across = std::sqrt(std::max(0.0, glm::dot(d, d) - along * along));
  return across * cosine - along * part.sine - part.radius_m - core.lever_m();
}

/// Directions in which a miss is looked for: to where the axis' support misses the middle, and across the core's
/// longest axis, where long cores spread least.
struct Directions {
  std::array<Vec3, 2> t;
  int count = 0;
};
Directions directions(const FingerCore& core, const SurfaceBounds& part, const Sight& sight, const Spread& s) {
  Directions d;
  const double room = part.sine * s.lambda_m;
  if (!(sight.away2 - sight.along * sight.along > room * room)) return d;  // a miss in no direction
  const auto add = [&](const Vec3& v, double least2) {
    const double length2 = glm::dot(v, v);
    if (length2 > least2) d.t[static_cast<std::size_t>(d.count++)] = v / std::sqrt(length2);
  };
  const Vec3& axis = part.normals.axis;
  add(sight.away - sight.along * axis, 0.0);
  add(glm::cross(core.long_axis(), axis), 0.01);
  return d;
}

/// By how much H exceeds the thickness T along the normal N at a place on the finger, at most.
/// Of an ellipsoid H = |A N| and T = 2 / (H N.A^-2 N). By Kantorovich's inequality N.A^-2 N <= (s - H^2) / (a c)^2 with
/// a and c the longest and the shortest axis and s = a^2 + c^2, so H > T only where y (s - y) > 2 (a c)^2, y = H^2: up
/// to the larger root of that, and nowhere where a/c + c/a <= sqrt 8. Of a capsule T is the ball's diameter at least.
/// The core's part of H is L sqrt(x^2 + w^2) at most, x the cosine to the axis; the line leaves the capsule R / sqrt(1
/// - x^2) behind the core's point or past half the axis, so H > T only where R < L sqrt(x^2 + w^2) sqrt(1 - x^2) <= L
/// (1 + w^2) / 2.
double support_over_thickness(const Finger& finger, double longest_m, double shortest_m) {
  if (finger.shape == FingerShape::capsule) {
    const double length = finger.half_length_m, over = 0.5 * length * (1.0 + kSpindle * kSpindle) - finger.radius_m;
    return over > 0.0 ? over * length * (1.0 + kSpindle) / finger.radius_m : 0.0;
  }
  const double a2 = longest_m * longest_m, c2 = shortest_m * shortest_m, s = a2 + c2, twice = 2.0 * a2 * c2;
  const double over = 0.25 * s * s - twice;
  return over > 0.0 ? over * std::sqrt(0.5 * s + std::sqrt(over)) / twice : 0.0;
}

}  // namespace

NormalCone cone_of(std::span<const Vec3> normals) {
  Vec3 sum(0.0);
  for (const Vec3& n : normals) sum += n;
  const double length2 = glm::dot(sum, sum);
  if (length2 < 1e-6) return {};
  NormalCone cone{sum / std::sqrt(length2), 1.0};
  double least2 = 1.0;
  for (const Vec3& n : normals) {
    const double along = glm::dot(n, cone.axis), n2 = std::max(1e-300, glm::dot(n, n));
    if (!(along > 0.0)) return {};
    least2 = std::min(least2, along * along / n2);
  }
  cone.cos_half = std::sqrt(least2);
  return cone;
}

FingerCore::FingerCore(const Finger& finger, const FingerPose& pose, bool turns)
    : centre_(pose.position), axes_m_(core_axes_m(finger)), rotation_(glm::mat3_cast(pose.orientation)), turns_(turns) {
  if (finger.shape != FingerShape::ellipsoid)
    ball_m_ = finger.shape == FingerShape::capsule ? finger.radius_m : finger.reach_m();
  reach_m_ = finger.reach_m();
  lever_m_ = finger.unroundness_m();
  std::array<double, 3> sorted{axes_m_.x, axes_m_.y, axes_m_.z};
  std::sort(sorted.begin(), sorted.end());
  longest_m_ = sorted[2];
  middle_m_ = sorted[1];
  shortest_m_ = sorted[0];
  const int longest = axes_m_.x >= longest_m_ ? 0 : axes_m_.y >= longest_m_ ? 1 : 2;
  long_axis_ = rotation_[longest];
  const Vec3 squares = axes_m_ * axes_m_;
  squares_m2_ = squares.x + squares.y + squares.z;
  pair2_m4_ = sorted[1] * sorted[1] * sorted[2] * sorted[2];
  flattest_core_m_ = sorted[0] > 0.0 ? sorted[2] * sorted[2] / sorted[0] : std::numeric_limits<double>::max();
  sharpest_m_ = sorted[2] > 0.0 ? sorted[0] * sorted[0] / sorted[2] : 0.0;
  if (longest_m_ == 0.0) flattest_core_m_ = 0.0;
  if (turns_ && lever_m_ > 0.0) {
    least_rate_ = std::max(1.0, std::hypot(lever_m_, longest_m_ - sharpest_m_) / reach_m_);
    const double fast =
        std::sqrt(std::max(0.0, least_rate_ * reach_m_ * least_rate_ * reach_m_ - lever_m_ * lever_m_)) + shortest_m_;
    slow_length_m_ =
        flattest_core_m_ <= fast ? 0.0 : std::min(longest_m_ * longest_m_ / fast, std::cbrt(pair2_m4_ / fast));
    slow_turn_ = reach_m_ / longest_m_;
  }
  if (longest_m_ > 0.0) over_m_ = support_over_thickness(finger, longest_m_, shortest_m_);
}

// |A tau|^2 + |A n|^2 + ... over an orthonormal frame is the sum of the squared axes.
double FingerCore::widest_step(const CoreSupport& s, double tangent) const {
  return std::min(longest_m_, std::sqrt(std::max(0.0, squares_m2_ - s.length * s.length))) * tangent;
}

double FingerCore::bend(const CoreSupport& s, double step_m) const {
  constexpr double kHalfSecond = 0.57735026918962584;  // 1/sqrt(3)
  if (step_m == 0.0) return 0.0;
  const double least = s.length - step_m;
  if (!(least > 0.0)) return std::numeric_limits<double>::infinity();
  return kHalfSecond * (step_m * step_m) / (least * least);
}

// Seen along any direction; that of the normal at the ellipsoid's nearest place is likely, x_i / (a_i^2 + t) with t as
// for a sphere of that width.
double FingerCore::apart_m(const Vec3& middle, const Vec3& half) const {
  const Vec3 x = (middle - centre_) * rotation_;
  const double distance2 = glm::dot(x, x);
  if (!(distance2 > 0.0)) return -reach_m_;
  const Vec3 squares = axes_m_ * axes_m_, ax = axes_m_ * x;
  const double t = std::max(0.0, std::sqrt(glm::dot(ax, ax)) - glm::dot(ax, ax) / distance2);
  const Vec3 n = x / (squares + (t + 1e-6 * squares_m2_));
  const Vec3 an = axes_m_ * n;
  const double reach = glm::dot(n, x) - std::sqrt(glm::dot(an, an)) - glm::dot(half, glm::abs(rotation_ * n));
  return reach / std::sqrt(glm::dot(n, n)) - ball_m_;
}

double FingerCore::flattest_near(const NormalCone& normals, double way_m) const {
  if (normals.cos_half < kWideCone) return flattest_m();
  const double chord = std::sqrt(2.0 - 2.0 * normals.cos_half);
  return ball_m_ + largest_radius(half_width(normals.axis) - longest_m_ * (chord + turn_within(way_m)));
}

// |A N|^2 at an angle x from the axis a is h^2 cos^2 x + 2 sin x cos x (A a).(A t) + |A t|^2 sin^2 x, h = |A a|, with t
// across a; (A a).(A t) is no more than what A^2 a has across a, and |A t|^2 than what the other axes leave.
double FingerCore::least_rank(const NormalCone& normals) const {
  const Vec3 y = scaled(normals.axis), z = axes_m_ * y;
  const double longest2 = longest_m_ * longest_m_, here2 = glm::dot(y, y);
  const double cosine = normals.cos_half;
  double most2 = longest2;
  if (cosine > kWidestCone) {
    const double across = std::sqrt(std::max(0.0, glm::dot(z, z) - here2 * here2));
    const double other2 = std::min(longest2, squares_m2_ - here2), half = 0.5 * (here2 - other2);
    const double cosine2 = 2.0 * cosine * cosine - 1.0, sine2 = std::sqrt(std::max(0.0, 1.0 - cosine2 * cosine2));
    const double turns = std::sqrt(half * half + across * across);
    const bool within = half > cosine2 * turns;  // the angle at which it is greatest, times two
    most2 = std::min(longest2, 0.5 * (here2 + other2) + (within ? turns : half * cosine2 + across * sine2));
  }
  return reach_m_ - ball_m_ - std::sqrt(most2) * (1.0 + 1e-12);
}

// S - c = q - h N with q = p(N) - c less its part along N, and h the height: |S - c|^2 = h^2 + |A g|^2 - |A N|^2. By
// Kantorovich's inequality |A g|^2 <= a^2 + c^2 - (a c)^2 / |A N|^2, a and c the longest and the shortest axis. From
// before, h = |A N| - d with d the depth less the ball; the sum is greatest at |A N|^3 = (a c)^2 / d. From inside, |A
// g|^2 - |A N|^2 is no more than (a - c)^2.
double FingerCore::farthest_m(double rank_m) const {
  const double a = longest_m_, c = shortest_m_, depth = reach_m_ - rank_m - ball_m_;
  double before2 = 0.0;
  if (depth <= a) {
    double length = a;
    if (depth > 0.0) length = std::clamp(std::cbrt(a * a * c * c / depth), std::max(c, depth), a);
    const double height = length - depth, ratio = length > 0.0 ? a * c / length : 0.0;
    before2 = std::max(0.0, height * height + a * a + c * c - ratio * ratio - length * length);
  }
  const double behind = rank_m - reach_m_;
  const double inside2 = behind >= 0.0 ? behind * behind + lever_m_ * lever_m_ : 0.0;
  return std::sqrt(std::max(before2, inside2)) * (1.0 + 1e-12);
}

double FingerCore::largest_radius(double least_length_m) const {
  if (!(least_length_m > 0.0)) return flattest_core_m_;
  const double per = 1.0 / least_length_m;
  return std::min({flattest_core_m_, longest_m_ * longest_m_ * per, pair2_m4_ * per * per * per});
}

// While the finger turns by w, p(N) goes across N by (H - R) (w x N) + (w.N) (N x q), H the core's support function, R
// its radii of curvature and q what p - c has across N, which is no more than the lever: the first by w's part across
// N, the second by that along it. Along N it may go, too: that changes lambda, and no direction.
double FingerCore::slide_rate(double least_length_m, double way_m) const {
  if (!turns_ || !(lever_m_ > 0.0)) return 1.0;
  const double radius = largest_radius(least_length_m - longest_m_ * turn_within(way_m));
  const double across = std::max(longest_m_ - sharpest_m_, radius - shortest_m_);
  return std::max(1.0, std::sqrt(lever_m_ * lever_m_ + across * across) / reach_m_);
}

// p(N) can't leave the core, whose width changes by no more than the way; lambda by no more, either.
double FingerCore::slide_m(double half_width_m, double least_length_m, double way_m) const {
  return std::min(slide_rate(least_length_m, way_m) * way_m, 2.0 * (way_m + half_width_m));
}

double FingerCore::way_within(double half_width_m, double least_length_m, double room_m) const {
  if (!(room_m > 0.0)) return 0.0;
  const double along = room_m / slide_rate(least_length_m, room_m);  // slides are no shorter than the way
  const double slow = std::min(room_m / least_rate_, slow_turn_ * (least_length_m - slow_length_m_));
  return std::max({along, slow, 0.5 * room_m - half_width_m});
}

double behind_m(const FingerCore& core, const SurfaceBounds& part) {
  const Vec3 d = core.centre() - part.middle;
  const double along = glm::dot(d, part.normals.axis);
  if (!(part.normals.cos_half > 0.0) || !(along < 0.0)) return 0.0;
  const double across = std::sqrt(std::max(0.0, glm::dot(d, d) - along * along));
  return -along * part.normals.cos_half - across * part.sine - part.radius_m;
}

// The same without its root.
bool is_behind(const FingerCore& core, const SurfaceBounds& part, double by_m) {
  const Vec3 d = core.centre() - part.middle;
  const double along = glm::dot(d, part.normals.axis), room = -along * part.normals.cos_half - part.radius_m - by_m;
  return part.normals.cos_half > 0.0 && room > 0.0 &&
         (glm::dot(d, d) - along * along) * part.sine * part.sine < room * room;
}

// As miss_of_centre is over the way, without its root.
bool is_beside(const FingerCore& core, const SurfaceBounds& part, double way_m) {
  const double cosine = part.normals.cos_half;
  if (cosine < kWidestCone) return false;
  const Vec3 d = core.centre() - part.middle;
  const double along = std::abs(glm::dot(d, part.normals.axis));
  const double room = along * part.sine + part.radius_m + core.lever_m() + way_m;
  return (glm::dot(d, d) - along * along) * cosine * cosine > room * room;
}

bool can_touch_at_a_glance(const FingerCore& core, const SurfaceBounds& part, double way_m) {
  if (part.normals.cos_half < kWidestCone) return true;
  const Sight sight(core, part);
  return sight.is_near(part) || !is_missed_by_cone(core, part, sight, way_m);
}

bool can_touch(const FingerCore& core, const SurfaceBounds& part, double most_m, double way_m) {
  const double cosine = part.normals.cos_half;
  if (cosine < kWidestCone) return true;
  const Sight sight(core, part);
  if (sight.is_near(part)) return true;
  if (is_missed_by_cone(core, part, sight, way_m)) return false;
  if (cosine < kWideCone) return true;
  Spread s = spread_over(core, part, sight);
  bound_curving(core, part, sight, s);
  // p(N) lies no lower over the axis' plane than p of the axis.
  if (sight.along - extent(part.half, part.normals.axis) - s.lambda_m * (1.0 - cosine) > most_m) return false;
  const Directions d = directions(core, part, sight, s);
  for (const Vec3& t : std::span(d.t).first(static_cast<std::size_t>(d.count))) {
    const double miss = miss_along(core, part, sight, s, t);
    if (miss > way_m && miss > core.slide_m(core.half_width(t), s.least_length_m, way_m)) return false;
  }
  return true;
}

double touch_margin(const FingerCore& core, const SurfaceBounds& part, double enough_m) {
  if (part.normals.cos_half < kWidestCone) return 0.0;
  double margin = std::max(0.0, miss_of_centre(core, part));
  if (margin > 0.0 && margin >= enough_m) return margin;
  const Sight sight(core, part);
  Spread s = spread_over(core, part, sight);
  margin = std::max(margin, core.way_within(core.longest_m(), s.least_length_m, miss_of_cone(core, part, sight)));
  if (part.normals.cos_half < kWideCone || (margin > 0.0 && margin >= enough_m)) return margin;
  bound_curving(core, part, sight, s);
  const Directions d = directions(core, part, sight, s);
  for (const Vec3& t : std::span(d.t).first(static_cast<std::size_t>(d.count))) {
    const double miss = miss_along(core, part, sight, s, t);
    if (miss > 0.0) margin = std::max(margin, core.way_within(core.half_width(t), s.least_length_m, miss));
  }
  return margin;
}

}  // namespace tangent
