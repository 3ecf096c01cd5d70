#include "core/contact/prove/miss_part.h"

namespace tangent::miss {

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
