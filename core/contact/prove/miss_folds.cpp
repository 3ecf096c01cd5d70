#include "core/contact/prove/miss_folds.h"

namespace tangent::miss {
namespace {

/// How far a fifth of the derivative of f along the side of a part from corner 0 to another is from `middle` at most.
template <int Corner>
double most_off(const Part& part, const Vec2& middle) {
  double most2 = 0.0;
#pragma GCC unroll 5
  for (int i = 0; i <= 4; ++i) {
#pragma GCC unroll 5
    for (int j = 0; j <= 4 - i; ++j) {
      const Vec2& end = part.f[Corner == 1 ? quintic_index(i, j + 1) : quintic_index(i, j)];
      const Vec2 d = end - part.f[quintic_index(i + 1, j)] - middle;
      most2 = std::max(most2, glm::dot(d, d));
    }
  }
  return std::sqrt(most2);
}

/// The derivatives of f along two sides of a part, a fifth of them, one of them less a share of the other, so that
/// their middles are across each other: by how much they are along their own direction at least and along the other at
/// most.
struct Spread {
  double turns = 0.0;  ///< the sign that their determinant has all over the part; 0: not known
  double first_own = 0.0, first_other = 0.0, second_own = 0.0, second_other = 0.0;
  Vec2 first, second;  ///< the two directions, in (u, v)

  /// Least size of the determinant.
  double room() const { return first_own * second_own - first_other * second_other; }
};

Spread spread(const Part& part) {
  const Vec2 to_1 = part.corner[1] - part.corner[0], to_2 = part.corner[2] - part.corner[0];
  const Vec2 a = 0.2 * (part.at_corner(1) - part.at_corner(0)), b = 0.2 * (part.at_corner(2) - part.at_corner(0));
  const bool swapped = glm::dot(b, b) > glm::dot(a, a);
  const Vec2 p = swapped ? b : a, q = swapped ? a : b;
  const double length2 = glm::dot(p, p);
  Spread out;
  if (!(length2 > 0.0)) return out;
  const Vec2 e = p / std::sqrt(length2);
  const double share = glm::dot(p, q) / length2, side = cross(p, q) > 0.0 ? 1.0 : -1.0;
  out.first = swapped ? to_2 : to_1;
  out.second = (swapped ? to_1 : to_2) - share * out.first;
  out.first_own = out.second_own = kUnbounded;
  const auto include = [&](int i, int j) {
    const Vec2& from = part.f[quintic_index(i + 1, j)];
    const Vec2 along_1 = part.f[quintic_index(i, j + 1)] - from, along_2 = part.f[quintic_index(i, j)] - from;
    const Vec2 first = swapped ? along_2 : along_1;
    const Vec2 second = (swapped ? along_1 : along_2) - share * first;
    out.first_own = std::min(out.first_own, glm::dot(e, first));
    out.first_other = std::max(out.first_other, std::abs(cross(e, first)));
    out.second_own = std::min(out.second_own, side * cross(e, second));
    out.second_other = std::max(out.second_other, std::abs(glm::dot(e, second)));
  };
  const auto is_known = [&] {
    return out.first_own > 0.0 && out.second_own > 0.0 && out.room() > 1e-9 * out.first_own * out.second_own;
  };
  include(4, 0);  // mostly the corners tell that nothing is known
  include(0, 4);
  include(0, 0);
  if (!is_known()) return out;
#pragma GCC unroll 4
  for (int i = 0; i <= 3; ++i) {
    const int first = i == 0 ? 1 : 0, last = i == 0 ? 3 : 4 - i;  // the others
#pragma GCC unroll 4
    for (int j = first; j <= last; ++j) include(i, j);
  }
  out.turns = is_known() ? (swapped ? -side : side) : 0.0;
  return out;
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

}  // namespace

bool could_be_stable(const Part& part, const Ground& ground) {
  const Vec2 xa = part.at_corner(0) - part.at_corner(1), xb = part.at_corner(0) - part.at_corner(2);
  if (!ground.gentle && ground.upright)
    return cross(xa, xb) * cross(part.corner[1] - part.corner[0], part.corner[2] - part.corner[0]) >= 0.0;
  const auto flat = [&](int k) { return ground.flat(part.corner[k]); };
  const Vec2 a = flat(1) - flat(0), b = flat(2) - flat(0);
  const double area = cross(a, b);
  return cross(xa, xb) * area >= 0.0 && (cross(xa, b) + cross(a, xb)) * area >= 0.0;
}

double folded_margin(const Part& part, const Ground& ground) {
  const Vec2 to_1 = part.corner[1] - part.corner[0], to_2 = part.corner[2] - part.corner[0];
  double margin = 0.0;
  const Spread all = spread(part);
  if (all.turns * cross(to_1, to_2) < 0.0) {
    // Moving c changes what both are and what is left for the other by as much.
    const double rate = 0.2 * (ground.turn(all.second) * (all.first_own + all.first_other) +
                               ground.turn(all.first) * (all.second_own + all.second_other));
    margin = all.room() / rate;
  }
  if (!ground.gentle) return std::min(margin, 1e300);
  const Vec2 flat_a = ground.flat(to_1), flat_b = ground.flat(to_2);
  const double side = cross(flat_a, flat_b) > 0.0 ? 1.0 : -1.0;
  const Vec2 middle_a = 0.2 * (part.at_corner(1) - part.at_corner(0));
  const Vec2 middle_b = 0.2 * (part.at_corner(2) - part.at_corner(0));
  const double trace = side * (cross(middle_a, flat_b) + cross(flat_a, middle_b));
  if (!(trace > 0.0)) return std::min(margin, 1e300);
  const double long_a = std::sqrt(glm::dot(flat_a, flat_a)), long_b = std::sqrt(glm::dot(flat_b, flat_b));
  const double trace_room = trace - (most_off<1>(part, middle_a) * long_b + most_off<2>(part, middle_b) * long_a);
  if (trace_room > 1e-9 * trace)
    margin = std::max(margin, trace_room / (0.2 * ground.turn(to_1) * long_b + 0.2 * ground.turn(to_2) * long_a));
  return std::min(margin, 1e300);
}

bool is_one_to_one(const Part& part) {
  return spread(part).turns * cross(part.corner[1] - part.corner[0], part.corner[2] - part.corner[0]) > 0.0;
}

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

}  // namespace tangent::miss
