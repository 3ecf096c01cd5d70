#include "core/surface/patch_edge.h"

namespace tangent {

static constexpr ControlPoint kCurve[3][4] = {
    {b300, b210, b120, b030}, {b030, b021, b012, b003}, {b003, b102, b201, b300}};
static constexpr ControlNormal kNormals[3][3] = {{n200, n110, n020}, {n020, n011, n002}, {n002, n101, n200}};

std::array<Vec3, 4> edge_points(const PnPatch& patch, std::uint32_t edge) {
  const auto& b = kCurve[edge];
  return {patch.control_point(b[0]), patch.control_point(b[1]), patch.control_point(b[2]), patch.control_point(b[3])};
}

std::array<Vec3, 3> edge_normal_coefficients(const PnPatch& patch, std::uint32_t edge) {
  const auto& n = kNormals[edge];
  return {patch.normals[n[0]], 0.5 * patch.mixed_weight * patch.normals[n[1]], patch.normals[n[2]]};
}

EdgeCurve edge_curve(const PnPatch& patch, std::uint32_t edge) {
  const auto& b = patch.offsets;
  const Vec3 &p0 = b[kCurve[edge][0]], &p1 = b[kCurve[edge][1]], &p2 = b[kCurve[edge][2]], &p3 = b[kCurve[edge][3]];
  return {patch.origin, {p0, 3.0 * (p1 - p0), 3.0 * ((p2 - p1) - (p1 - p0)), (p3 - p0) - 3.0 * (p2 - p1)}};
}

EdgeNormals edge_normals(const PnPatch& patch, std::uint32_t edge) {
  const auto [n0, n1, n2] = edge_normal_coefficients(patch, edge);
  return {{n0, 2.0 * (n1 - n0), (n2 - n1) - (n1 - n0)}, flat_normal(patch)};
}

EdgeNormals reversed(const EdgeNormals& normals) {
  const auto& p = normals.powers;
  return {{p[0] + p[1] + p[2], -p[1] - 2.0 * p[2], p[2]}, normals.flat};
}

}  // namespace tangent
