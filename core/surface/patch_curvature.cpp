#include "core/surface/patch_curvature.h"

#include "core/base/tolerances.h"

#include <array>
#include <cmath>

namespace tangent {
namespace {

/// Derivatives along two orthogonal unit directions of the flat triangle, by their Bezier coefficients.
struct Derivatives {
  std::array<Vec3, 6> point_x, point_y;    ///< quadratic
  std::array<Vec3, 3> normal_x, normal_y;  ///< linear
};

/// Coefficients of the derivatives of a form along v1 - v0 or v2 - v0, degree times a difference of its own.
struct Difference {
  std::uint8_t u, v, w;
};
constexpr Difference kPointTerms[6] = {{b210, b201, b300}, {b030, b021, b120}, {b012, b003, b102},
                                       {b120, b111, b210}, {b021, b012, b111}, {b111, b102, b201}};
constexpr Difference kNormalTerms[3] = {{n110, n101, n200}, {n020, n011, n110}, {n011, n002, n101}};

/// u and v as functions of x along the first side and y across it: 1/a, and (-c/(a b), 1/b).
Derivatives derivatives(const PnPatch& patch, const Vec3& x, const Vec3& y) {
  const double a = glm::dot(patch.offsets[b030], x), b = glm::dot(patch.offsets[b003], y);
  const double c = glm::dot(patch.offsets[b003], x);
  Derivatives d;
  const auto differentiate = [&](const auto& from, const Difference& term, double degree, Vec3& along_x,
                                 Vec3& along_y) {
    const Vec3 u = degree * (from[term.u] - from[term.w]), v = degree * (from[term.v] - from[term.w]);
    along_x = u / a;
    along_y = (v - (c / a) * u) / b;
  };
  for (std::size_t i = 0; i < 6; ++i) differentiate(patch.offsets, kPointTerms[i], 3.0, d.point_x[i], d.point_y[i]);
  for (std::size_t i = 0; i < 3; ++i) differentiate(patch.normals, kNormalTerms[i], 2.0, d.normal_x[i], d.normal_y[i]);
  return d;
}

struct Exponents {
  int i, j, k;  // of w, u, v
};
constexpr Exponents kQuadratic[6] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
constexpr Exponents kLinear[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

constexpr int factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }
constexpr double multinomial(Exponents e) {
  return static_cast<double>(factorial(e.i + e.j + e.k)) / (factorial(e.i) * factorial(e.j) * factorial(e.k));
}

/// Of the product of a quadratic with a form of `Terms` coefficients (6 quadratic, 3 linear): to which coefficient each
/// pair contributes, and its share of that.
template <int Terms>
struct ProductTable {
  static constexpr int kDegree = Terms == 6 ? 4 : 3;
  static constexpr std::size_t kSize = (kDegree + 1) * (kDegree + 2) / 2;
  std::size_t index[6][Terms]{};
  double share[6][Terms]{};
  constexpr ProductTable() {
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < Terms; ++b) {
        const Exponents p = kQuadratic[a], q = Terms == 6 ? kQuadratic[b] : kLinear[b];
        const Exponents sum{p.i + q.i, p.j + q.j, p.k + q.k};
        const int rest = kDegree - sum.i;
        index[a][b] = static_cast<std::size_t>(rest * (rest + 1) / 2 + rest - sum.j);
        share[a][b] = multinomial(p) * multinomial(q) / multinomial(sum);
      }
  }
};

/// Of the product of three quadratics: to which of the 28 coefficients each three contribute, and their share of that.
struct TripleTable {
  std::size_t index[6][6][6]{};
  double share[6][6][6]{};
  constexpr TripleTable() {
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        for (int c = 0; c < 6; ++c) {
          const Exponents p = kQuadratic[a], q = kQuadratic[b], r = kQuadratic[c];
          const Exponents sum{p.i + q.i + r.i, p.j + q.j + r.j, p.k + q.k + r.k};
          const int rest = 6 - sum.i;
          index[a][b][c] = static_cast<std::size_t>(rest * (rest + 1) / 2 + rest - sum.j);
          share[a][b][c] = multinomial(p) * multinomial(q) * multinomial(r) / multinomial(sum);
        }
  }
};
constexpr TripleTable kTriple;

/// Greatest length of (first.along_x, first.along_y) over the patch, of a quadratic and the derivatives of another
/// form.
template <std::size_t Terms>
double greatest_product(const std::array<Vec3, 6>& first, const std::array<Vec3, Terms>& along_x,
                        const std::array<Vec3, Terms>& along_y) {
  static constexpr ProductTable<static_cast<int>(Terms)> kTable;
  std::array<Vec2, kTable.kSize> sums;
  sums.fill(Vec2(0.0));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < Terms; ++j)
      sums[kTable.index[i][j]] +=
          kTable.share[i][j] * Vec2(glm::dot(first[i], along_x[j]), glm::dot(first[i], along_y[j]));
  double greatest2 = 0.0;
  for (const Vec2& sum : sums) greatest2 = std::max(greatest2, glm::dot(sum, sum));
  return std::sqrt(greatest2);
}

/// Of dn.dS along any unit direction: eigenvalues of the symmetric part, which lie within those of the coefficients'.
CurvatureBounds bend(const Derivatives& d) {
  static constexpr ProductTable<3> kTable;
  std::array<Vec3, kTable.kSize> sums;  // xx, yy, xy
  sums.fill(Vec3(0.0));
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      sums[kTable.index[i][j]] +=
          kTable.share[i][j] *
          Vec3(glm::dot(d.point_x[i], d.normal_x[j]), glm::dot(d.point_y[i], d.normal_y[j]),
               0.5 * (glm::dot(d.point_x[i], d.normal_y[j]) + glm::dot(d.point_y[i], d.normal_x[j])));
  CurvatureBounds bounds{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const Vec3& sum : sums) {
    const double middle = 0.5 * (sum.x + sum.y), apart = 0.5 * (sum.x - sum.y);
    const double half = std::sqrt(apart * apart + sum.z * sum.z);
    bounds.include({middle - half, middle + half});
  }
  return bounds;
}

/// What the bounds need of a patch besides: how far it is from the flat triangle and N from the surface's own normal.
struct Room {
  double stretch = 0.0;        ///< | |dS| - 1 | along unit directions of the flat triangle at most
  double shortest = 1.0;       ///< |n| at least
  double lean = 0.0;           ///< |n.dS| at most
  double shrinking = 0.0;      ///< |n.dn| at most
  double towards_front = 1.0;  ///< n along the flat triangle's normal at least
};

Room room_of(const PnPatch& patch, const Derivatives& d, const Vec3& x, const Vec3& y) {
  const Vec3 sum = patch.normals[n200] + patch.normals[n020] + patch.normals[n002], flat = glm::cross(x, y);
  const Vec3 axis = sum / std::max(1e-300, std::sqrt(glm::dot(sum, sum)));
  Room room;
  for (const Vec3& n : patch.normals) {
    room.shortest = std::min(room.shortest, glm::dot(n, axis));
    room.towards_front = std::min(room.towards_front, glm::dot(n, flat));
  }
  double stretch2 = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 off_x = d.point_x[i] - x, off_y = d.point_y[i] - y;
    stretch2 = std::max(stretch2, glm::dot(off_x, off_x) + glm::dot(off_y, off_y));
  }
  room.stretch = std::sqrt(stretch2);
  room.lean = greatest_product(patch.normals, d.point_x, d.point_y);
  room.shrinking = greatest_product(patch.normals, d.normal_x, d.normal_y);
  return room;
}

}  // namespace

// The product (S_u x S_v).n has the sign of its coefficients where that is one.
bool keeps_front(const PnPatch& patch) {
  std::array<Vec3, 6> along_u, along_v;
  for (std::size_t i = 0; i < 6; ++i) {
    const Difference& term = kPointTerms[i];
    along_u[i] = patch.offsets[term.u] - patch.offsets[term.w];
    along_v[i] = patch.offsets[term.v] - patch.offsets[term.w];
  }
  std::array<double, 28> product{};
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) {
      const Vec3 across = glm::cross(along_u[a], along_v[b]);
      for (std::size_t c = 0; c < 6; ++c)
        product[kTriple.index[a][b][c]] +=
            kTriple.share[a][b][c] * (c < n110 ? 1.0 : 0.5 * patch.mixed_weight) * glm::dot(across, patch.normals[c]);
    }
  double least = product[0], most = 0.0;
  for (const double x : product) {
    least = std::min(least, x);
    most = std::max(most, std::abs(x));
  }
  return least > 1e-12 * most;
}

CurvatureBounds curvature_bounds(const PnPatch& patch) {
  constexpr double kMostStretch = 0.4, kLeastFront = 0.5;
  const double most_lean = std::sqrt(kSteadyLean);
  if (patch.mixed_weight != 2.0) return {};
  const Vec3 &first = patch.offsets[b030], &second = patch.offsets[b003];
  const double length2 = glm::dot(first, first);
  if (!(length2 > 0.0)) return {};
  const Vec3 x = first / std::sqrt(length2), across = second - glm::dot(second, x) * x;
  const double width2 = glm::dot(across, across);
  if (!(width2 > 1e-12 * glm::dot(second, second))) return {};
  const Vec3 y = across / std::sqrt(width2);
  const Derivatives d = derivatives(patch, x, y);
  const Room room = room_of(patch, d, x, y);
  if (!(room.stretch <= kMostStretch) || !(room.towards_front >= kLeastFront)) return {};
  const double narrow = (1.0 - room.stretch) * (1.0 - room.stretch);
  if (!(room.lean <= most_lean * room.shortest * (1.0 - room.stretch))) return {};

  // dN.dS = (dn.dS) / |n| - (n.dn)(n.dS) / |n|^3, over |dS|^2.
  const double second_order = room.shrinking * room.lean / (room.shortest * room.shortest * room.shortest * narrow);
  const CurvatureBounds unscaled = bend(d);
  const double scale = 1.0 / (room.shortest * narrow);
  return {scale * std::min(0.0, unscaled.least) - second_order,
          scale * std::max(0.0, unscaled.greatest) + second_order};
}

}  // namespace tangent
