// The misses of a patch's normals, as face_proof.h tests them: f over a part of the patch, and what its coefficients
// exclude. f is a map to the plane, a quintic in Bernstein form with 21 coefficients.
#pragma once

#include "core/base/lanes.h"
#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace tangent::miss {

/// The components along two directions side by side, so that both go through one instruction.
using QuinticMap = std::array<Vec2, 21>;

/// Of the coefficient with exponents i of w and j of u.
constexpr int quintic_index(int i, int j) { return (5 - i) * (6 - i) / 2 + (5 - i - j); }

inline Vec2 perpendicular(const Vec2& a) { return {-a.y, a.x}; }
inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

inline constexpr double kUnbounded = 1e300;  ///< m

/// f as it is.
struct NoSlack {
  static constexpr bool kNone = true;
};

/// f known but for a vector of these hulls (StandIn in face_proof.h).
struct Slack {
  static constexpr bool kNone = false;
  std::array<Vec2, 6> spread;
  std::size_t spread_count;
  Vec2 bend;
  double rest_m;
  bool place_wanted;
  double height_matters_m;
  Vec2 longest{0.0};  ///< across it f is known best

  /// By how much f may be wrong across a direction, times its length, besides rest_m.
  double beside(const Vec2& side) const {
    double widest = 0.0;
    for (const Vec2& x : std::span(spread).first(spread_count)) widest = std::max(widest, std::abs(cross(x, side)));
    return widest + std::abs(cross(bend, side));
  }

  /// Whether what looks like that value may be 0, as far as the longest direction tells: no part that has it can be
  /// excluded.
  bool may_be_zero(const Vec2& value) const {
    constexpr double kRounding = 1e-12;
    const double length2 = glm::dot(longest, longest);
    const double along = length2 > 0.0 ? std::clamp(glm::dot(value, longest) / length2, -1.0, 1.0) : 0.0;
    const Vec2 off = value - along * longest;
    const double room = rest_m - kRounding * std::sqrt(length2);
    return room > 0.0 && glm::dot(off, off) < room * room;
  }
};

/// f over a part of the patch whose corners lie at these (u, v).
struct Part {
  QuinticMap f;
  std::array<Vec2, 3> corner;
  int depth = 0;

  /// Distance of 0 from the values of f, as far as the line across the direction to their middle and the three along
  /// the images of the sides can tell; where the first says `enough_m`, the others are not asked, and none further once
  /// one says `most_m`, the most that counts. 0 where they don't exclude it.
  double margin(double enough_m, double most_m) const {
    const Vec2 f0 = at_corner(0), f1 = at_corner(1), f2 = at_corner(2);
    const double a = cross(f0, f1), b = cross(f1, f2), c = cross(f2, f0);
    const bool between = a > 0.0 ? std::min(b, c) > 0.0 : a < 0.0 && std::max(b, c) < 0.0;
    if (between) return 0.0;  // 0 lies between the corners'
    double clear = beside(perpendicular(f0 + f1 + f2));
    if (clear > 0.0 && clear >= std::min(enough_m, most_m)) return clear;
    for (const Vec2& side : {f1 - f0, f2 - f1, f0 - f2}) {
      clear = std::max(clear, beside(side));
      if (clear > 0.0 && clear >= most_m) return clear;
    }
    return clear;
  }

  double margin(double enough_m, double most_m, const NoSlack&) const { return margin(enough_m, most_m); }
  /// The same of f known but for that.
  double margin(double enough_m, double, const Slack& slack) const {
    const Vec2 f0 = at_corner(0), f1 = at_corner(1), f2 = at_corner(2);
    double most = 0.0;
    for (const Vec2& side : {perpendicular(f0 + f1 + f2), slack.longest, f1 - f0, f2 - f1, f0 - f2}) {
      // All coefficients are no clearer than those of the corners, which mostly tell that there is no room.
      double turned = 1.0;
      const double corners = corners_beside(side, turned);
      if (!(corners > 0.0)) continue;
      const double length = std::sqrt(glm::dot(side, side)), spread = slack.beside(side);
      const double wanted = spread + (slack.rest_m + most) * length;
      if (!(corners > wanted)) continue;
      const double least = least_across(turned * side);
      if (least > wanted) most = (least - spread) / length - slack.rest_m;
      if (most > 0.0 && most >= enough_m) return most;
    }
    return most;
  }

  /// Distance of 0 from the coefficients across direction `side`, 0 if they lie on both sides of it: mostly the corners
  /// tell that.
  double beside(const Vec2& side) const {
    const auto across = [&](const Vec2& x) { return side.y * x.x - side.x * x.y; };
    const double a = across(at_corner(0)), b = across(at_corner(1)), c = across(at_corner(2));
    if (!(a > 0.0 ? std::min(b, c) > 0.0 : a < 0.0 && std::max(b, c) < 0.0)) return 0.0;
    const double least = least_across(a > 0.0 ? side : -side);
    return least > 0.0 ? least / std::sqrt(glm::dot(side, side)) : 0.0;
  }

  /// Least of the coefficients across a direction, two by two.
  double least_across(const Vec2& side) const {
    const Two y = {side.y, side.y}, x = {side.x, side.x};
    Two least = {kUnbounded, kUnbounded};
    const auto include = [&](const Vec2& a, const Vec2& b) {
      const Two across = y * Two{a.x, b.x} - x * Two{a.y, b.y};
      least = across < least ? across : least;
    };
#pragma GCC unroll 10
    for (std::size_t k = 0; k + 1 < f.size(); k += 2) include(f[k], f[k + 1]);
    include(f.back(), f.back());
    return std::min(least[0], least[1]);
  }

  /// The least of the corners' coefficients across a direction or, as `turned` says, its opposite, times its length;
  /// not over 0 if they lie on both sides.
  double corners_beside(const Vec2& side, double& turned) const {
    const auto across = [&](const Vec2& x) { return side.y * x.x - side.x * x.y; };
    const double a = across(at_corner(0)), b = across(at_corner(1)), c = across(at_corner(2));
    turned = a > 0.0 ? 1.0 : -1.0;
    return std::min({turned * a, turned * b, turned * c});
  }

  /// (u, v) where the linear interpolation of f vanishes, within the part.
  Vec2 linear_zero() const {
    const Vec2 f0 = at_corner(0), a = at_corner(1) - f0, b = at_corner(2) - f0;
    const double det = cross(a, b);
    double x = 1.0 / 3.0, y = 1.0 / 3.0;
    if (det != 0.0) {
      x = std::clamp(cross(b, f0) / det, 0.0, 1.0);
      y = std::clamp(cross(f0, a) / det, 0.0, 1.0 - x);
    }
    return corner[0] + x * (corner[1] - corner[0]) + y * (corner[2] - corner[0]);
  }

  Vec2 at_corner(int k) const {
    constexpr int kIndex[3] = {quintic_index(5, 0), quintic_index(0, 5), quintic_index(0, 0)};
    return f[kIndex[k]];
  }
};

/// Turns a part so that its edge from corner 0 to corner 1 is the one with the longest image, where that is twice as
/// long: on steep ground images are stretched, and what stays in a row of slivers is bisected in vain.
void put_longest_first(Part& part);
/// Halves of a part at the middle of the edge from corner 0 to corner 1, by de Casteljau along each row of that
/// direction. In both the part's corner 2 comes before the middle or after it, so that the next bisection halves
/// another edge.
void bisect(const Part& part, Part& first, Part& second);

}  // namespace tangent::miss
