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
  if (!(longest_m > 0.0) || reach <= kFingerToMesh * longest_m) return {};
  std::array<char, 200> text;
  std::snprintf(
      text.data(), text.size(),
      "the finger reaches %.4g mm, %.4g times the mesh's longest side of %.4g mm: check --unit or --fit-mm of "
      "the mesh, and the finger of the preset",
      reach * 1e3, reach / longest_m, longest_m * 1e3);
  return text.data();
}

}  // namespace tangent
