#include "core/contact/exclusion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {
namespace {

using Cubic = std::array<double, 10>;     // in ControlPoint order
using Quadratic = std::array<double, 6>;  // in ControlNormal order
using Quintic = std::array<double, 21>;

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

/// Distance of 0 from the range of the coefficients, 0 if they have both signs.
double one_signed(const Quintic& f) {
  const auto [low, high] = std::minmax_element(f.begin(), f.end());
  return std::max({0.0, *low, -*high});
}

}  // namespace

PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre) {
  // Mixed terms weighted 1 (NormalForm::vlachos) are half control normals of the Bernstein form.
  const double mixed = 0.5 * patch.mixed_weight;
  const Vec3 sum = patch.normals[n200] + patch.normals[n020] + patch.normals[n002];
  const double length = std::sqrt(glm::dot(sum, sum));
  if (length < 0.1) return {};
  const Vec3 axis = sum / length;
  const Vec3 c = centre - patch.origin;
  const Vec3 away = c - (patch.offsets[b030] + patch.offsets[b003]) / 3.0;
  Vec3 t = away - glm::dot(away, axis) * axis;
  const double sideways = std::sqrt(glm::dot(t, t));
  if (sideways > 1e-6 * std::sqrt(glm::dot(away, away))) {
    t /= sideways;
  } else {
    t = unit(glm::cross(axis, std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  }
  const Vec3 s = glm::cross(axis, t);

  Quadratic nt, ns, na;
  for (int b = 0; b < 6; ++b) {
    const Vec3 n = (b < n110 ? 1.0 : mixed) * patch.normals[b];
    nt[b] = glm::dot(n, t), ns[b] = glm::dot(n, s), na[b] = glm::dot(n, axis);
  }
  Quintic ft{}, fs{}, height{};
  for (int a = 0; a < 10; ++a) {
    const Vec3 d = c - patch.offsets[a];
    const double dt = glm::dot(d, t), ds = glm::dot(d, s), da = glm::dot(d, axis);
    for (int b = 0; b < 6; ++b) {
      const double w = kProduct.weight[a][b];
      const int k = kProduct.index[a][b];
      ft[k] += w * (dt * na[b] - nt[b] * da);
      fs[k] += w * (ds * na[b] - ns[b] * da);
      height[k] += w * (dt * nt[b] + ds * ns[b] + da * na[b]);
    }
  }
  return {std::max(one_signed(ft), one_signed(fs)), std::max(0.0, *std::min_element(height.begin(), height.end()))};
}

}  // namespace tangent
