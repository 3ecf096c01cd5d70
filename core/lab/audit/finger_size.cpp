#include "core/lab/audit/finger_size.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace tangent {

double longest_side_m(const ContactMesh& mesh) {
  const Vec3 size = mesh.bounds().size();
  return std::max({size.x, size.y, size.z});
}

std::string finger_size_note(double longest_m, const Finger& finger) {
  const double reach = finger.reach_m();
  if (!(longest_m > 0.0) || !(reach > 0.0)) return {};
  constexpr const char* kCheck = ": check --unit or --fit-mm of the mesh, and the finger of the preset";
  std::array<char, 120> sizes;
  if (reach > kFingerToMesh * longest_m)
    std::snprintf(sizes.data(), sizes.size(),
                  "the finger reaches %.4g mm, %.4g times the mesh's longest side of %.4g mm", reach * 1e3,
                  reach / longest_m, longest_m * 1e3);
  else if (longest_m > kMeshToFinger * reach)
    std::snprintf(sizes.data(), sizes.size(), "the mesh is %.4g mm long, %.4g times the finger's reach of %.4g mm",
                  longest_m * 1e3, longest_m / reach, reach * 1e3);
  else
    return {};
  return std::string(sizes.data()) + kCheck;
}

}  // namespace tangent
