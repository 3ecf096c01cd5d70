#include "core/lab/audit/finger_size.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace tangent {

std::string finger_size_note(const ContactMesh& mesh, const Finger& finger) {
  const Vec3 size = mesh.bounds().size();
  const double longest = std::max({size.x, size.y, size.z}), reach = finger.reach_m();
  if (!(longest > 0.0) || reach <= kFingerToMesh * longest) return {};
  std::array<char, 200> text;
  std::snprintf(
      text.data(), text.size(),
      "the finger reaches %.4g mm, %.4g times the mesh's longest side of %.4g mm: check --unit or --fit-mm of "
      "the mesh, and the finger of the preset",
      reach * 1e3, reach / longest, longest * 1e3);
  return text.data();
}

}  // namespace tangent
