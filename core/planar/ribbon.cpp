#include "core/planar/ribbon.h"

#include "core/planar/polygon_contact.h"

namespace tangent {

PolygonMesh ribbon(const PlanarCurve& curve, double half_width_m) {
  const PolygonSurface surface(curve, 0.0);
  PolygonMesh mesh;
  mesh.name = curve.polygon().name;
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    if (curve.patch(i).joint_after != CurveJoint::smooth) continue;
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 a = lifted(curve.origin() + curve.vertex(i)), b = lifted(curve.origin() + curve.vertex(curve.after(i)));
    const Vec3 up(0.0, 0.0, half_width_m);
    for (const Vec3& p : {a - up, b - up, b + up, a + up}) mesh.positions.push_back(p);
    const Vec3 na = lifted(surface.vertex_normal(i, false)), nb = lifted(surface.vertex_normal(i, true));
    for (const Vec3& n : {na, nb, nb, na}) mesh.normals.push_back(n);
    // Counter-clockwise as seen from the finger's side.
    if (curve.side() > 0.0) {
      mesh.add_face({base + 3, base + 2, base + 1, base});
    } else {
      mesh.add_face({base, base + 1, base + 2, base + 3});
    }
  }
  mesh.corner_normal = mesh.corner_position;
  return mesh;
}

}  // namespace tangent
