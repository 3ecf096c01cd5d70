#include "core/surface/mesh_patch.h"

#include "core/base/triangle.h"

#include <algorithm>

namespace tangent {

PnPatch make_patch(const ContactMesh& mesh, std::uint32_t t, NormalForm form) {
  const auto p = mesh.positions(t);
  const auto n = mesh.normals(t);
  PnPatch patch = make_pn_patch(p, n, form);
  bool creased = false;
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    if (mesh.edge_kind(t, edge) != EdgeKind::crease) continue;
    creased = true;
    const std::uint32_t i = edge, j = (edge + 1) % 3;
    // Across the edge the neighbour runs the other way: its corner `e` is our j, its corner `e+1` our i.
    const EdgeLink other = mesh.across(t, edge);
    const Vec3& ni = mesh.normal(other.triangle, (other.edge + 1) % 3);
    const Vec3& nj = mesh.normal(other.triangle, other.edge);
    set_edge_points(patch, static_cast<int>(edge), crease_control_offset(p[j] - p[i], n[i], ni),
                    crease_control_offset(p[i] - p[j], n[j], nj));
  }
  if (creased) set_centre_point(patch);
  return patch;
}

double patch_bulge(const PnPatch& patch) {
  const auto& b = patch.offsets;
  double largest2 = 0.0;
  for (const Vec3& q : b)
    largest2 = std::max(largest2, closest_point_on_triangle(b[b300], b[b030], b[b003], q).distance2);
  return std::sqrt(largest2);
}

}  // namespace tangent
