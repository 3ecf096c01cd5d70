#include "core/shading/way_out.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

// With d = sum of l_i n_i, l >= 0: where l_i > 0 the plane is just left, n_i . d + kSoft l_i = p_i, elsewhere
// n_i . d >= p_i. kSoft makes the equations of any planes, parallel or opposite ones, solvable: each plane may be left
// short by kSoft l_i, for a price. That keeps d the gradient of a smoothed distance, so that it still changes by no
// more than the finger moves.

/// Ratio, see above. Larger: corners are left short; smaller: rounding decides between opposite planes.
constexpr double kSoft = 1e-8;

struct Equations {
  std::array<std::array<double, kMostPlanes>, kMostPlanes> a{};  ///< n_i . n_j, plus kSoft on the diagonal
  std::array<double, kMostPlanes> p{};
  std::size_t count = 0;
};

using Pushes = std::array<double, kMostPlanes>;

/// l of the planes in `set` (bits), zero elsewhere. Gauss on a positive definite matrix needs no pivots.
Pushes solve(const Equations& e, unsigned set) {
  std::array<std::size_t, kMostPlanes> in{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < e.count; ++i)
    if (set >> i & 1u) in[n++] = i;
  std::array<std::array<double, kMostPlanes + 1>, kMostPlanes> m{};
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t c = 0; c < n; ++c) m[r][c] = e.a[in[r]][in[c]];
    m[r][n] = e.p[in[r]];
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t r = k + 1; r < n; ++r) {
      const double f = m[r][k] / m[k][k];
      for (std::size_t c = k; c <= n; ++c) m[r][c] -= f * m[k][c];
    }
  Pushes l{};
  for (std::size_t k = n; k-- > 0;) {
    double rest = m[k][n];
    for (std::size_t c = k + 1; c < n; ++c) rest -= m[k][c] * l[in[c]];
    l[in[k]] = rest / m[k][k];
  }
  return l;
}

/// By how much the conditions are missed, m: pulls, and planes that are not left.
double missed(const Equations& e, unsigned set, const Pushes& l) {
  double most = 0.0;
  for (std::size_t i = 0; i < e.count; ++i) {
    if (set >> i & 1u) {
      most = std::max(most, -l[i]);
      continue;
    }
    double left = 0.0;
    for (std::size_t j = 0; j < e.count; ++j) left += e.a[i][j] * l[j];
    most = std::max(most, e.p[i] - left);
  }
  return most;
}

}  // namespace

Vec3 shortest_way_out(std::span<const RenderPlane> planes) {
  Equations e;
  e.count = planes.size();
  for (std::size_t i = 0; i < e.count; ++i) {
    e.p[i] = planes[i].penetration_m;
    for (std::size_t j = 0; j < e.count; ++j) e.a[i][j] = glm::dot(planes[i].normal, planes[j].normal);
    e.a[i][i] += kSoft;
  }
  Pushes best{};
  double least = std::numeric_limits<double>::infinity();
  for (unsigned set = 0; set < 1u << e.count && least > 0.0; ++set) {
    const Pushes l = solve(e, set);
    const double miss = missed(e, set, l);
    if (miss < least) least = miss, best = l;
  }
  Vec3 way(0.0);
  for (std::size_t i = 0; i < e.count; ++i) way += best[i] * planes[i].normal;
  return way;
}

RenderPlane plane_of_way_out(const Vec3& way_out, const RenderPlane& one) {
  const double length = std::sqrt(glm::dot(way_out, way_out));
  if (!(length > 0.0)) return one;
  return {way_out / length, length, 1.0};
}

}  // namespace tangent
