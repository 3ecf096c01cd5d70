#include "core/contact/prove/face_proof.h"

#include "core/base/lanes.h"
#include "core/base/tolerances.h"
#include "core/contact/prove/certain_margin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace tangent {
namespace {

using Quintic = std::array<double, 21>;
/// f as a map to the plane: the components along t and s side by side, so that both go through one instruction.
using QuinticMap = std::array<Vec2, 21>;

struct Exponents {
  int i, j, k;  // of w, u, v
};
constexpr Exponents kCubicExponents[10] = {{3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {2, 1, 0}, {1, 2, 0},
                                           {0, 2, 1}, {0, 1, 2}, {1, 0, 2}, {2, 0, 1}, {1, 1, 1}};
constexpr Exponents kQuadraticExponents[6] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};

constexpr int factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }
constexpr double multinomial(Exponents e) {
  return static_cast<double>(factorial(e.i + e.j + e.k)) / (factorial(e.i) * factorial(e.j) * factorial(e.k));
}
constexpr int quintic_index(int i, int j) { return (5 - i) * (6 - i) / 2 + (5 - i - j); }

/// Weights of the product of two Bernstein forms: C(3;I) C(2;J) / C(5;I+J).
struct ProductTable {
  int index[10][6]{};
  double weight[10][6]{};
  constexpr ProductTable() {
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 6; ++b) {
        const Exponents p = kCubicExponents[a], q = kQuadraticExponents[b];
        const Exponents sum{p.i + q.i, p.j + q.j, p.k + q.k};
        index[a][b] = quintic_index(sum.i, sum.j);
        weight[a][b] = multinomial(p) * multinomial(q) / multinomial(sum);
      }
  }
};
constexpr ProductTable kProduct;

Vec2 perpendicular(const Vec2& a) { return {-a.y, a.x}; }
double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

constexpr double kUnbounded = 1e300;  // m
constexpr int kSettledDepth = 2;      // bisections after which a part is asked for its one zero
constexpr int kSlackTests = 6;        // parts of a face known roughly: smaller ones tell no more

/// f as it is.
struct NoSlack {
  static constexpr bool kNone = true;
};

/// f known but for a vector of these hulls (StandIn).
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
    double clear = beside(perpendicular(f0 + f1 + f2));
    if (clear > 0.0 && clear >= std::min(enough_m, most_m)) return clear;
    for (const Vec2& side : {f1 - f0, f2 - f1, f0 - f2}) {
      clear = std::max(clear, beside(side));
      if (clear > 0.0 && clear >= most_m) return clear;
    }
    return clear;
  }

  double margin(double enough_m, double most_m, const NoSlack&) const { return margin(enough_m, most_m); }
  /// Whether it is in vain to look at the part, or at any that it consists of.
  bool in_vain(const Slack& slack) const {
    return !slack.place_wanted &&
           (slack.may_be_zero(at_corner(0)) || slack.may_be_zero(at_corner(1)) || slack.may_be_zero(at_corner(2)));
  }
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

/// Halves of a part at the middle of the edge from corner 0 to corner 1, by de Casteljau along each row of that
/// direction. In both the part's corner 2 comes before the middle or after it, so that the next bisection halves
/// another edge.
void bisect(const Part& part, Part& first, Part& second) {
#pragma GCC unroll 6
  for (int k = 0; k <= 5; ++k) {
    const int degree = 5 - k;
    std::array<Vec2, 6> row;
#pragma GCC unroll 6
    for (int j = 0; j <= degree; ++j) row[j] = part.f[quintic_index(degree - j, j)];
#pragma GCC unroll 6
    for (int level = 0; level <= degree; ++level) {
      first.f[quintic_index(level, k)] = row[0];
      second.f[quintic_index(degree - level, k)] = row[degree - level];
#pragma GCC unroll 6
      for (int j = 0; j < degree - level; ++j) row[j] = 0.5 * (row[j] + row[j + 1]);
    }
  }
  const Vec2 middle = 0.5 * (part.corner[0] + part.corner[1]);
  first.corner = {middle, part.corner[2], part.corner[0]};
  second.corner = {part.corner[1], part.corner[2], middle};
  first.depth = second.depth = part.depth + 1;
}

/// Whether a contact in this part could be stable: det M and trace M of the linear interpolation of f, where
/// -df is the image of the step and `edge_u`, `edge_v` are the flat triangle's sides in the same two directions.
bool could_be_stable(const Part& part, const Vec2& edge_u, const Vec2& edge_v) {
  const auto flat = [&](int k) { return part.corner[k].x * edge_u + part.corner[k].y * edge_v; };
  const Vec2 a = flat(1) - flat(0), b = flat(2) - flat(0);
  const Vec2 xa = part.at_corner(0) - part.at_corner(1), xb = part.at_corner(0) - part.at_corner(2);
  const double area = cross(a, b);
  return cross(xa, xb) * area >= 0.0 && (cross(xa, b) + cross(a, xb)) * area >= 0.0;
}

/// What folds are judged by, besides f: the flat triangle's sides, and how fast the normal turns along u and v.
struct Ground {
  bool gentle = false;
  Vec2 edge_u, edge_v;
  double turn_u = 0.0, turn_v = 0.0;

  Vec2 flat(const Vec2& uv) const { return uv.x * edge_u + uv.y * edge_v; }
  double turn(const Vec2& uv) const { return std::abs(uv.x) * turn_u + std::abs(uv.y) * turn_v; }
};

/// Derivative of f along the side of a part from corner 0 to another: a fifth of it lies within `off` of `middle`.
struct SideDerivative {
  Vec2 middle;
  double off = 0.0;
};

template <int Corner>
SideDerivative side_derivative(const Part& part) {
  SideDerivative side{0.2 * (part.at_corner(Corner) - part.at_corner(0))};
  double most2 = 0.0;
#pragma GCC unroll 5
  for (int i = 0; i <= 4; ++i) {
#pragma GCC unroll 5
    for (int j = 0; j <= 4 - i; ++j) {
      const Vec2& end = part.f[Corner == 1 ? quintic_index(i, j + 1) : quintic_index(i, j)];
      const Vec2 d = end - part.f[quintic_index(i + 1, j)] - side.middle;
      most2 = std::max(most2, glm::dot(d, d));
    }
  }
  side.off = std::sqrt(most2);
  return side;
}

/// How far c may move until a contact in this part could be stable: while det M or trace M is negative all over it. 0
/// where neither is now. Signs as in could_be_stable; moving c by m changes the derivatives of f by m times those of n.
[[gnu::noinline]] double folded_margin(const Part& part, const Ground& ground) {
  const SideDerivative a = side_derivative<1>(part), b = side_derivative<2>(part);
  const Vec2 to_1 = part.corner[1] - part.corner[0], to_2 = part.corner[2] - part.corner[0];
  const Vec2 flat_a = ground.flat(to_1), flat_b = ground.flat(to_2);
  const double turn_a = 0.2 * ground.turn(to_1), turn_b = 0.2 * ground.turn(to_2);
  const double side = cross(flat_a, flat_b) > 0.0 ? 1.0 : -1.0;
  const auto length = [](const Vec2& x) { return std::sqrt(glm::dot(x, x)); };
  const double long_a = length(a.middle) + a.off, long_b = length(b.middle) + b.off;

  const double det = -side * cross(a.middle, b.middle);
  const double det_room = det - (long_a * long_b - (long_a - a.off) * (long_b - b.off));
  double margin = 0.0;
  if (det_room > 1e-9 * det) {
    const double rate = long_a * turn_b + long_b * turn_a;
    margin = 2.0 * det_room / (rate + std::sqrt(rate * rate + 4.0 * turn_a * turn_b * det_room));
  }
  const double trace = side * (cross(a.middle, flat_b) + cross(flat_a, b.middle));
  const double trace_room = trace - (a.off * length(flat_b) + b.off * length(flat_a));
  if (trace_room > 1e-9 * trace)
    margin = std::max(margin, trace_room / (turn_a * length(flat_b) + turn_b * length(flat_a)));
  return std::min(margin, 1e300);
}

/// f at the place x, y along the two sides from corner 0 of a part, by de Casteljau, and its derivatives there.
struct QuinticValue {
  Vec2 f, dx, dy;
};
QuinticValue value_at(const Part& part, double x, double y) {
  QuinticMap row = part.f;
  const double rest = 1.0 - x - y;
#pragma GCC unroll 4
  for (int degree = 4; degree >= 1; --degree) {
    int k = 0;
#pragma GCC unroll 5
    for (int i = degree; i >= 0; --i) {
      const int below = degree - i;
#pragma GCC unroll 5
      for (int j = below; j >= 0; --j, ++k) {  // in place: row[k] of the finer degree isn't read after it
        const int next = (below + 1) * (below + 2) / 2 + below - j;
        row[k] = rest * row[k] + x * row[next] + y * row[next + 1];
      }
    }
  }
  const Vec2 dx = 5.0 * (row[1] - row[0]), dy = 5.0 * (row[2] - row[0]);
  return {rest * row[0] + x * row[1] + y * row[2], dx, dy};
}

/// Whether f takes no value twice in a part, and its contacts are stable as far as det M tells: its derivatives along
/// two sides stay so near to their middles that no mean of them has a determinant of 0.
bool is_one_to_one(const Part& part, const Ground& ground) {
  const SideDerivative a = side_derivative<1>(part), b = side_derivative<2>(part);
  const auto length = [](const Vec2& x) { return std::sqrt(glm::dot(x, x)); };
  const double area = cross(ground.flat(part.corner[1] - part.corner[0]), ground.flat(part.corner[2] - part.corner[0]));
  const double det = (area > 0.0 ? 1.0 : -1.0) * cross(a.middle, b.middle);
  return det > 0.0 && det > 1.0001 * (a.off * length(b.middle) + b.off * length(a.middle) + a.off * b.off);
}

/// Newton's steps from the middle of a part to a zero of f. Whether they come to one in the patch, or just beside it,
/// and find it stable as far as det M tells.
bool find_zero(const Part& part, const Ground& ground, Vec2& uv) {
  constexpr int kSteps = 6;
  constexpr double kSettled = 1e-6, kRoom = 1e-6;  // of the part and of the patch
  const Vec2 side_x = part.corner[1] - part.corner[0], side_y = part.corner[2] - part.corner[0];
  const double area = cross(ground.flat(side_x), ground.flat(side_y));
  double x = 1.0 / 3.0, y = 1.0 / 3.0;
  for (int step = 0; step < kSteps; ++step) {
    const QuinticValue at = value_at(part, x, y);
    const double det = cross(at.dx, at.dy);
    if (!(det * area > 0.0)) return false;
    const double dx = -cross(at.f, at.dy) / det, dy = -cross(at.dx, at.f) / det;
    x += dx;
    y += dy;
    uv = part.corner[0] + x * side_x + y * side_y;
    if (std::max(std::abs(dx), std::abs(dy)) < kSettled) return std::min({uv.x, uv.y, 1.0 - uv.x - uv.y}) > -kRoom;
    if (!(std::min({uv.x, uv.y, 1.0 - uv.x - uv.y}) > -0.5)) return false;
  }
  return false;
}

/// Excludes what can be of the parts of `whole`, where a margin of `enough_m` need not be the widest.
template <class Slack>
void bisect_parts(const Part& whole, const Ground& ground, double enough_m, double rounding_m, const Slack& slack,
                  PatchExclusion& result) {
  std::array<Part, kBisections + 2> stack;
  std::size_t size = 0;
  stack[size++] = whole;
  double margin = kUnbounded;
  double smallest = kUnbounded;
  result.possible = false;
  const auto give_up = [&] {
    result.possible = true;
    result.margin_m = 0.0;
  };
  for (int tests = 0; size > 0; ++tests) {
    ++result.tests;
    const Part& part = stack[--size];
    if constexpr (!Slack::kNone) {
      if (part.in_vain(slack)) return give_up();
    }
    const double here =  // the whole's was asked for
        tests > 0 ? certain_margin(part.margin(enough_m, margin, slack), rounding_m) : 0.0;
    if (here > 0.0) {
      margin = std::min(margin, here);
      continue;
    }
    const bool stable = could_be_stable(part, ground.edge_u, ground.edge_v);
    Vec2 zero;
    if (Slack::kNone && stable && part.depth >= kSettledDepth && is_one_to_one(part, ground) &&
        find_zero(part, ground, zero)) {
      margin = smallest = 0.0;
      result.hold(zero);
      continue;
    }
    const double folded = Slack::kNone && ground.gentle && !stable ? folded_margin(part, ground) : 0.0;
    if (folded > 0.0) {
      margin = enough_m > 0.0 ? std::min(margin, folded) : 0.0;
      continue;
    }
    if (part.depth < kBisections && tests < (Slack::kNone ? kBisectionTests : kSlackTests)) {
      const Part halved = part;  // its place is its halves' now
      bisect(halved, stack[size], stack[size + 1]);
      size += 2;
      continue;
    }
    if constexpr (!Slack::kNone) {
      if (!slack.place_wanted) return give_up();
    }
    margin = 0.0;
    // Of a part near a fold, or left over large, or of a patch that bends much, or known roughly, corners don't tell.
    if (Slack::kNone && ground.gentle && !stable && folded_margin(part, ground) > 0.0) continue;
    const Vec2 uv = part.linear_zero();
    const Vec2 middle = (part.at_corner(0) + part.at_corner(1) + part.at_corner(2)) / 3.0;
    const bool found = Slack::kNone && find_zero(part, ground, zero);
    const double off = found ? 0.0 : glm::dot(middle, middle);
    if (off >= smallest) continue;
    smallest = off;
    result.hold(found ? zero : uv);
  }
  result.margin_m = margin;
}

/// Products of the cubic d and the quadratic n, term by term with constant indices and weights.
template <std::size_t... Term>
void multiply_miss(const std::array<Vec3, 10>& d, const std::array<Vec3, 6>& n, QuinticMap& f,
                   std::index_sequence<Term...>) {
  const auto add = [&]<std::size_t A, std::size_t B>() {
    f[kProduct.index[A][B]] += kProduct.weight[A][B] * (n[B].z * Vec2(d[A].x, d[A].y) - d[A].z * Vec2(n[B].x, n[B].y));
  };
  (add.template operator()<Term / 6, Term % 6>(), ...);
}

template <std::size_t... Term>
void multiply_height(const std::array<Vec3, 10>& d, const std::array<Vec3, 6>& n, Quintic& height,
                     std::index_sequence<Term...>) {
  ((height[kProduct.index[Term / 6][Term % 6]] +=
    kProduct.weight[Term / 6][Term % 6] * glm::dot(d[Term / 6], n[Term % 6])),
   ...);
}

/// c - S and N by their control points, in a frame (t, s, axis) about the middle of the normals.
struct Factors {
  Vec3 centre, t, s, axis;  ///< c relative to corner 0; the directions
  double rounding_m;        ///< of f
  std::array<Vec3, 10> d;
  std::array<Vec3, 6> n;

  /// False where the corner normals have no middle.
  bool set(const PnPatch& patch, const Vec3& c) {
    // Mixed terms weighted 1 (NormalForm::vlachos) are half control normals of the Bernstein form.
    const double mixed = 0.5 * patch.mixed_weight;
    const Vec3 sum = patch.normals[n200] + patch.normals[n020] + patch.normals[n002];
    const double length = std::sqrt(glm::dot(sum, sum));
    if (length < 0.1) return false;
    axis = sum / length;
    centre = c - patch.origin;
    rounding_m = rounding_of_margin(c, patch.origin);
    const Vec3 away = centre - (patch.offsets[b030] + patch.offsets[b003]) / 3.0;
    t = away - glm::dot(away, axis) * axis;
    const double sideways = std::sqrt(glm::dot(t, t));
    if (sideways > 1e-6 * std::sqrt(glm::dot(away, away))) {
      t /= sideways;
    } else {
      t = unit(glm::cross(axis, std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    }
    s = glm::cross(axis, t);
    // Two of the three products at once, terms in the order of glm::dot.
    const Vec2 x(t.x, s.x), y(t.y, s.y), z(t.z, s.z);
    const auto in_frame = [&](const Vec3& v) {
      const Vec2 across = v.x * x + v.y * y + v.z * z;
      return Vec3(across.x, across.y, glm::dot(v, axis));
    };
    for (std::size_t b = 0; b < 6; ++b) n[b] = in_frame((b < n110 ? 1.0 : mixed) * patch.normals[b]);
    for (std::size_t a = 0; a < 10; ++a) d[a] = in_frame(centre - patch.offsets[a]);
    return true;
  }

  /// Whether a test holds for f at any of the corners.
  template <class Test>
  bool any_corner(Test test) const {
    const auto at = [&](std::size_t k) { return n[k].z * Vec2(d[k].x, d[k].y) - d[k].z * Vec2(n[k].x, n[k].y); };
    return test(at(0)) || test(at(1)) || test(at(2));
  }

  Ground ground(const std::array<Vec3, 2>& sides) const {
    const auto in_frame = [&](const Vec3& x) { return Vec2(glm::dot(x, t), glm::dot(x, s)); };
    const auto turn = [&](ControlNormal a0, ControlNormal a1, ControlNormal b0, ControlNormal b1, ControlNormal c0,
                          ControlNormal c1) {
      const Vec3 a = n[a1] - n[a0], b = n[b1] - n[b0], c = n[c1] - n[c0];
      return 2.0 * std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}));
    };
    // All that folds are judged by rests on the flat triangle: only where the patch is near it.
    constexpr double kGentle = 0.9;
    const Vec3 flat = glm::cross(sides[0], sides[1]);
    bool gentle = glm::dot(flat, axis) > kGentle * std::sqrt(glm::dot(flat, flat));
    for (const Vec3& x : n) gentle = gentle && x.z > kGentle;
    return {gentle, in_frame(sides[0]), in_frame(sides[1]), turn(n200, n110, n110, n020, n101, n011),
            turn(n200, n101, n101, n002, n110, n011)};
  }

  /// No more than that.
  double corners_height_m() const {
    return std::min({glm::dot(d[0], n[0]), glm::dot(d[1], n[1]), glm::dot(d[2], n[2])});
  }
  double least_height_m() const {
    Quintic height{};
    multiply_height(d, n, height, std::make_index_sequence<60>());
    double least = height[0];
    for (const double x : height) least = std::min(least, x);  // std::min_element goes by pointers and branches
    return std::max(0.0, least);
  }
};

/// S at (u, v) and (c - S).N, without the derivatives that a plane for stepping needs. `c` and S relative to corner 0.
double estimated_height(const PnPatch& patch, const Vec3& c, double u, double v, Vec3& point) {
  const double w = 1.0 - u - v;
  const auto& b = patch.offsets;
  point = w * w * w * b[b300] + u * u * u * b[b030] + v * v * v * b[b003] + 6.0 * w * u * v * b[b111] +
          3.0 * (w * w * (u * b[b210] + v * b[b201]) + u * u * (w * b[b120] + v * b[b021]) +
                 v * v * (u * b[b012] + w * b[b102]));
  const auto& n = patch.normals;
  const Vec3 normal = w * w * n[n200] + u * u * n[n020] + v * v * n[n002] +
                      patch.mixed_weight * (w * u * n[n110] + u * v * n[n011] + w * v * n[n101]);
  return glm::dot(c - point, normal) / std::sqrt(glm::dot(normal, normal));
}

}  // namespace

static double least_height_m(const Factors& factors, const NoSlack&) { return factors.least_height_m(); }
static double least_height_m(const Factors& factors, const Slack& slack) {
  return factors.corners_height_m() > slack.height_matters_m ? factors.least_height_m() : 0.0;
}

/// Of the patch by its factors; `patch` again for the place.
template <class Slack>
static PatchExclusion exclude(const PnPatch& patch, const Factors& factors, double enough_m, const Slack& slack,
                              const std::array<Vec3, 2>& sides) {
  PatchExclusion result;
  if constexpr (!Slack::kNone) {
    if (!slack.place_wanted && factors.any_corner([&](const Vec2& f) { return slack.may_be_zero(f); })) {
      result.least_height_m = least_height_m(factors, slack);
      return result;
    }
  }
  result.tests = 1;
  Part whole;
  whole.f.fill(Vec2(0.0));
  whole.corner = {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0)};
  multiply_miss(factors.d, factors.n, whole.f, std::make_index_sequence<60>());
  result.margin_m = certain_margin(whole.margin(enough_m, kUnbounded, slack), factors.rounding_m);
  if (result.margin_m > 0.0) result.possible = false;
  if (result.margin_m > 0.0 && result.margin_m >= enough_m) return result;
  result.least_height_m = least_height_m(factors, slack);
  if (!result.possible) return result;
  bisect_parts(whole, factors.ground(sides), enough_m, factors.rounding_m, slack, result);
  if (result.margin_m > 0.0) result.possible = false;
  if (!result.possible) return result;
  if constexpr (!Slack::kNone) {
    if (!slack.place_wanted) return result;
  }
  result.height_m = estimated_height(patch, factors.centre, result.u, result.v, result.point);
  result.point += patch.origin;
  return result;
}

PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m) {
  Factors factors;
  if (!factors.set(patch, centre)) return {};
  return exclude(patch, factors, enough_m, NoSlack{}, {patch.offsets[b030], patch.offsets[b003]});
}

PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m, const StandIn& stands_for) {
  Factors factors;
  if (!factors.set(patch, centre)) return {};
  const auto in_frame = [&](const Vec3& x) { return Vec2(glm::dot(x, factors.t), glm::dot(x, factors.s)); };
  Slack slack{{},
              stands_for.spread_count,
              in_frame(stands_for.bend),
              stands_for.rest_m,
              stands_for.place_wanted,
              stands_for.height_matters_m};
  for (std::size_t i = 0; i < slack.spread_count; ++i) {
    slack.spread[i] = in_frame(stands_for.spread[i]);
    if (glm::dot(slack.spread[i], slack.spread[i]) > glm::dot(slack.longest, slack.longest))
      slack.longest = slack.spread[i];
  }
  return exclude(patch, factors, enough_m, slack, stands_for.sides);
}

bool excludes_at_a_glance(const PnPatch& patch, const Vec3& centre, const RankBound& bound, double enough_m) {
  Factors factors;
  if (!factors.set(patch, centre)) return false;
  Part whole;
  whole.f.fill(Vec2(0.0));
  multiply_miss(factors.d, factors.n, whole.f, std::make_index_sequence<60>());
  return whole.margin(enough_m, enough_m) >= enough_m || bound.way_to(factors.least_height_m()) >= enough_m;
}

double corner_exclusion(const ContactMesh& mesh, std::uint32_t t, const Vec3& centre) {
  constexpr double kGentle = 0.75;  // corner normals within 41 degrees: the patch bends less than it is wide
  const auto p = mesh.positions(t);
  const auto n = mesh.normals(t);
  if (glm::dot(n[0], n[1]) < kGentle || glm::dot(n[1], n[2]) < kGentle || glm::dot(n[2], n[0]) < kGentle) return 0.0;
  const Vec3 a = glm::cross(centre - p[0], n[0]), b = glm::cross(centre - p[1], n[1]),
             c = glm::cross(centre - p[2], n[2]);
  const Vec3 mean = (a + b + c) / 3.0;
  const auto square = [](const Vec3& v) { return glm::dot(v, v); };
  const double wide2 = std::max({square(a - mean), square(b - mean), square(c - mean)});
  const double least = std::min({glm::dot(a, mean), glm::dot(b, mean), glm::dot(c, mean)});
  if (!(least > 0.0)) return 0.0;
  return certain_margin(least / std::sqrt(square(mean)) - std::sqrt(wide2), rounding_of_margin(centre, p[0]));
}

}  // namespace tangent
