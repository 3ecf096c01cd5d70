#include "core/base/triangle.h"

#include <algorithm>

namespace tangent {
namespace {

TrianglePoint at(const Vec3& a, const Vec3& ab, const Vec3& ac, double u, double v, const Vec3& q) {
  TrianglePoint r;
  r.u = u;
  r.v = v;
  r.point = a + u * ab + v * ac;
  const Vec3 d = q - r.point;
  r.distance2 = glm::dot(d, d);
  return r;
}

double ratio(double numerator, double denominator) {
  return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, 1.0) : 0.0;
}

}  // namespace

TrianglePoint closest_point_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& q) {
  const Vec3 ab = b - a, ac = c - a, aq = q - a;
  const double d1 = glm::dot(ab, aq), d2 = glm::dot(ac, aq);
  if (d1 <= 0.0 && d2 <= 0.0) return at(a, ab, ac, 0.0, 0.0, q);

  const Vec3 bq = q - b;
  const double d3 = glm::dot(ab, bq), d4 = glm::dot(ac, bq);
  if (d3 >= 0.0 && d4 <= d3) return at(a, ab, ac, 1.0, 0.0, q);

  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return at(a, ab, ac, ratio(d1, d1 - d3), 0.0, q);

  const Vec3 cq = q - c;
  const double d5 = glm::dot(ab, cq), d6 = glm::dot(ac, cq);
  if (d6 >= 0.0 && d5 <= d6) return at(a, ab, ac, 0.0, 1.0, q);

  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return at(a, ab, ac, 0.0, ratio(d2, d2 - d6), q);

  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = ratio(d4 - d3, (d4 - d3) + (d5 - d6));
    return at(a, ab, ac, 1.0 - t, t, q);
  }
  const double sum = va + vb + vc;
  if (!(sum > 0.0)) return at(a, ab, ac, 0.0, 0.0, q);
  return at(a, ab, ac, vb / sum, vc / sum, q);
}

}  // namespace tangent
