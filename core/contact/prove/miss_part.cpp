#include "core/contact/prove/miss_part.h"

namespace tangent::miss {

void put_longest_first(Part& part) {
  constexpr double kMuch = 4.0;  // times as long, squared
  const Vec2 f0 = part.at_corner(0), f1 = part.at_corner(1), f2 = part.at_corner(2);
  const double a = glm::dot(f1 - f0, f1 - f0), b = glm::dot(f2 - f1, f2 - f1), c = glm::dot(f0 - f2, f0 - f2);
  if (kMuch * a >= b && kMuch * a >= c) return;
  const auto turn = [&](int by, auto from) {
    const QuinticMap f = part.f;
    const std::array<Vec2, 3> corner = part.corner;
#pragma GCC unroll 6
    for (int i = 0; i <= 5; ++i)
#pragma GCC unroll 6
      for (int j = 0; j <= 5 - i; ++j) part.f[quintic_index(i, j)] = f[from(i, j, 5 - i - j)];
#pragma GCC unroll 3
    for (int n = 0; n < 3; ++n) part.corner[n] = corner[(n + by) % 3];
  };
  if (b >= c) {
    turn(1, [](int i, int, int k) { return quintic_index(k, i); });
  } else {
    turn(2, [](int, int j, int k) { return quintic_index(j, k); });
  }
}

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

}  // namespace tangent::miss
