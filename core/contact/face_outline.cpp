#include "core/contact/face_outline.h"

#include <algorithm>
#include <cmath>

namespace tangent {

FaceOutline face_outline(const ContactMesh& mesh, std::uint32_t t, NormalForm form) {
  const std::array<Vec3, 3> p = mesh.positions(t), n = mesh.normals(t);
  FaceOutline outline;
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
    outline.middle_normals[k] = share * (sum - (2.0 * glm::dot(side, sum) / side2) * side);
  }
  return outline;
}

}  // namespace tangent
