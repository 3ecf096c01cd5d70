#include "core/contact/prove/corner_misses.h"

#include <algorithm>
#include <cmath>

namespace tangent {

CornerMisses::CornerMisses(const ContactMesh& mesh, std::uint32_t t, const std::array<Vec3, 3>& points)
    : p(mesh.positions(t)), n(mesh.normals(t)) {
  for (std::size_t k = 0; k < 3; ++k) {
    away[k] = points[k] - p[k];
    miss[k] = glm::cross(away[k], n[k]);
  }
  const Vec3 middle = miss[0] + miss[1] + miss[2];
  const double length = std::sqrt(glm::dot(middle, middle));
  if (length > 0.0) look_along(middle / length);
}

void CornerMisses::look_along(const Vec3& direction) {
  along = glm::dot(miss[0], direction) < 0.0 ? -direction : direction;
  least_ = std::max(0.0, std::min({glm::dot(miss[0], along), glm::dot(miss[1], along), glm::dot(miss[2], along)}));
}

bool CornerMisses::middle_normals(NormalForm form, std::array<Vec3, 3>& middle) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t j = (k + 1) % 3;
    const Vec3 side = p[j] - p[k], sum = n[k] + n[j];
    const double side2 = glm::dot(side, side), sum2 = glm::dot(sum, sum);
    if (!(sum2 > 1e-6)) return false;
    const double share = (form == NormalForm::bernstein ? 1.0 : 0.5) / std::sqrt(sum2);
    middle[k] = share * (sum - (2.0 * glm::dot(side, sum) / side2) * side);
  }
  return true;
}

double CornerMisses::lean(const ContactMesh& mesh, std::uint32_t t) const {
  double most = 0.0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t j = (k + 1) % 3;
    const Vec3 side = p[j] - p[k];
    const bool smooth = mesh.edge_kind(t, k) == EdgeKind::smooth;
    most = std::max(most, smooth ? std::max(std::abs(glm::dot(side, n[k])), std::abs(glm::dot(side, n[j])))
                                 : std::sqrt(glm::dot(side, side)));
  }
  return most;
}

double CornerMisses::clear(const ContactMesh& mesh, std::uint32_t t, NormalForm form) const {
  std::array<Vec3, 3> middle;
  if (!(least_ > 0.0) || !middle_normals(form, middle)) return 0.0;
  std::array<Vec3, 6> q;  // (c - P) x N along it is (c - P).q
  for (std::size_t k = 0; k < 3; ++k) {
    q[k] = glm::cross(n[k], along);
    q[3 + k] = glm::cross(middle[k], along);
  }
  const auto g = [&](std::size_t point, std::size_t normal) { return glm::dot(away[point], q[normal]); };
  double smallest = least_;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t j = (k + 1) % 3;
    smallest = std::min(smallest, (g(j, k) + 2.0 * g(k, 3 + k)) / 3.0);
    smallest = std::min(smallest, (g(k, j) + 2.0 * g(j, 3 + k)) / 3.0);
  }
  smallest = std::min(smallest, (g(0, 4) + g(1, 5) + g(2, 3)) / 3.0);
  return std::max(0.0, smallest - lean(mesh, t) / 3.0);
}

double CornerMisses::clear(const ContactMesh& mesh, std::uint32_t t, const std::array<Vec3, 3>& middle_normals,
                           const std::array<Vec3, 3>& middle_points) const {
  if (!(least_ > 0.0)) return 0.0;
  std::array<Vec3, 6> a, q;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = away[k];
    a[3 + k] = middle_points[k] - 0.5 * (p[k] + p[(k + 1) % 3]);
    q[k] = glm::cross(n[k], along);
    q[3 + k] = glm::cross(middle_normals[k], along);
  }
  const auto g = [&](std::size_t point, std::size_t normal) { return glm::dot(a[point], q[normal]); };
  double smallest = least_;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t j = (k + 1) % 3, side = 3 + k, next = 3 + j, last = 3 + (k + 2) % 3;
    smallest = std::min(smallest, (g(k, side) + g(side, k)) / 2.0);
    smallest = std::min(smallest, (g(j, side) + g(side, j)) / 2.0);
    smallest = std::min(smallest, (g(k, j) + g(j, k) + 4.0 * g(side, side)) / 6.0);
    smallest = std::min(smallest, (g(k, next) + g(next, k) + 2.0 * (g(side, last) + g(last, side))) / 6.0);
  }
  return std::max(0.0, smallest - lean(mesh, t) / 3.0);
}

}  // namespace tangent
