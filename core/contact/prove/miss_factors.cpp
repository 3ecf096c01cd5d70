#include "core/contact/prove/miss_factors.h"

#include "core/contact/prove/certain_margin.h"

#include <utility>

namespace tangent::miss {
namespace {

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

/// Products of the cubic d and the quadratic n, coefficient by coefficient with constant indices and weights.
template <std::size_t I, std::size_t... Term>
Two miss_coefficient(const std::array<InFrame, 10>& d, const std::array<InFrame, 6>& n, std::index_sequence<Term...>) {
  Two sum{};
  const auto add = [&]<std::size_t A, std::size_t B>() {
    if constexpr (kProduct.index[A][B] == static_cast<int>(I))
      sum += kProduct.weight[A][B] * (n[B].along * d[A].across - d[A].along * n[B].across);
  };
  (add.template operator()<Term / 6, Term % 6>(), ...);
  return sum;
}
template <std::size_t... I>
void multiply_miss(const std::array<InFrame, 10>& d, const std::array<InFrame, 6>& n, QuinticMap& f,
                   std::index_sequence<I...>) {
  const auto set = [&]<std::size_t K>() {
    const Two sum = miss_coefficient<K>(d, n, std::make_index_sequence<60>());
    f[K] = {sum[0], sum[1]};
  };
  (set.template operator()<I>(), ...);
}

}  // namespace

bool Factors::set(const PnPatch& patch, const Vec3& c) {
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
  // Terms in the order of glm::dot.
  const Two x{t.x, s.x}, y{t.y, s.y}, z{t.z, s.z};
  const Two ax{axis.x, axis.x}, ay{axis.y, axis.y}, az{axis.z, axis.z};
  const auto in_frame = [&](double vx, double vy, double vz) {
    const Two v0{vx, vx}, v1{vy, vy}, v2{vz, vz};
    return InFrame{v0 * x + v1 * y + v2 * z, v0 * ax + v1 * ay + v2 * az};
  };
  for (std::size_t b = 0; b < 6; ++b) {
    const double share = b < n110 ? 1.0 : mixed;
    const Vec3& normal = patch.normals[b];
    n[b] = in_frame(share * normal.x, share * normal.y, share * normal.z);
  }
  for (std::size_t a = 0; a < 10; ++a) {
    const Vec3& offset = patch.offsets[a];
    d[a] = in_frame(centre.x - offset.x, centre.y - offset.y, centre.z - offset.z);
  }
  return true;
}

Ground Factors::ground(const std::array<Vec3, 2>& sides) const {
  const auto in_frame = [&](const Vec3& x) { return Vec2(glm::dot(x, t), glm::dot(x, s)); };
  const auto turn = [&](ControlNormal a0, ControlNormal a1, ControlNormal b0, ControlNormal b1, ControlNormal c0,
                        ControlNormal c1) {
    const Vec3 a = n[a1].vector() - n[a0].vector(), b = n[b1].vector() - n[b0].vector(),
               c = n[c1].vector() - n[c0].vector();
    return 2.0 * std::sqrt(std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}));
  };
  // All that folds are judged by rests on the flat triangle: only where the patch is near it.
  constexpr double kGentle = 0.9;
  const Vec3 flat = glm::cross(sides[0], sides[1]);
  bool gentle = glm::dot(flat, axis) > kGentle * std::sqrt(glm::dot(flat, flat));
  bool upright = true;
  for (const InFrame& x : n) {
    gentle = gentle && x.z() > kGentle;
    upright = upright && x.z() > 0.0;
  }
  return {gentle,
          upright,
          in_frame(sides[0]),
          in_frame(sides[1]),
          turn(n200, n110, n110, n020, n101, n011),
          turn(n200, n101, n101, n002, n110, n011)};
}

Part Factors::whole() const {
  Part part;
  part.corner = {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0)};
  multiply_miss(d, n, part.f, std::make_index_sequence<21>());
  return part;
}

}  // namespace tangent::miss
