#include "core/contact/face_outline.h"

#include "core/base/float_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {

static FourVec3 lanes_of(const std::array<Vec3, 3>& v) {
  FourVec3 lanes;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](std::size_t i) { return static_cast<float>(v[i][k]); };
    lanes[static_cast<std::size_t>(k)] = Four{at(0), at(1), at(2), at(0)};
  }
  return lanes;
}

FaceOutline face_outline(const ContactMesh& mesh, std::uint32_t t, NormalForm form) {
  const std::array<Vec3, 3> p = mesh.positions(t), n = mesh.normals(t);
  FaceOutline outline{};
  outline.origin = p[0];
  std::array<Vec3, 3> middle_normals{};
  outline.has_middles = true;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t j = (k + 1) % 3;
    const Vec3 side = p[j] - p[k], sum = n[k] + n[j];
    const double side2 = glm::dot(side, side), sum2 = glm::dot(sum, sum);
    const bool smooth = mesh.edge_kind(t, k) == EdgeKind::smooth;
    const double lean =
        smooth ? std::max(std::abs(glm::dot(side, n[k])), std::abs(glm::dot(side, n[j]))) : std::sqrt(side2);
    outline.lean_m = std::max(outline.lean_m, lean);
    if (!(sum2 > 1e-6)) {
      outline.has_middles = false;
      continue;
    }
    const double share = (form == NormalForm::bernstein ? 1.0 : 0.5) / std::sqrt(sum2);
    middle_normals[k] = share * (sum - (2.0 * glm::dot(side, sum) / side2) * side);
  }
  const std::array<Vec3, 3> from_first{Vec3(0.0), p[1] - p[0], p[2] - p[0]};
  const double size2 = std::max(glm::dot(from_first[1], from_first[1]), glm::dot(from_first[2], from_first[2]));
  outline.lanes = {lanes_of(from_first), lanes_of(n), lanes_of(middle_normals), above(std::sqrt(size2))};
  return outline;
}

}  // namespace tangent
