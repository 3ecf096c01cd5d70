// The C interface: audit and decimation.
#include "core/lab/audit/finger_size.h"
#include "core/lab/audit/mesh_audit.h"
#include "core/lab/measure/decimate.h"
#include "workbench/embed/c_handle.h"

#include <cmath>

namespace tangent::c {
namespace {

void copy_range(const MinMedianMax& from, double (&to)[3]) { to[0] = from.min, to[1] = from.median, to[2] = from.max; }

void write_audit(const MeshAudit& from, tangent_mesh_audit& to) {
  to.file_vertices = from.file_vertices, to.file_faces = from.file_faces;
  to.triangles = from.triangles, to.usable_triangles = from.usable_triangles;
  to.vertices = from.vertices, to.edges = from.edges, to.components = from.components;
  to.boundary_edges = from.boundary_edges, to.boundary_loops = from.boundary_loops;
  to.non_manifold_edges = from.non_manifold_edges, to.non_manifold_vertices = from.non_manifold_vertices;
  to.inconsistent_edges = from.inconsistent_edges, to.crease_edges = from.crease_edges;
  to.sliver_triangles = from.sliver_triangles;
  to.flipped_normals = from.flipped_normals, to.wild_normals = from.wild_normals;
  to.area_m2 = from.area_m2, to.max_normal_to_face_deg = from.max_normal_to_face_deg;
  copy_range(from.edge_length_m, to.edge_length_m);
  copy_range(from.dihedral_deg, to.dihedral_deg);
  copy_range(from.aspect, to.aspect);
}

bool positive(double value) { return value > 0.0 && std::isfinite(value); }

Error needs_mesh(const char* where) { return {"a 2D scene has no mesh of its own", where, "give a 3D scene"}; }

tangent_status decimate_to(const tangent_scene& scene, const tangent_decimate_options& options, tangent_scene& coarse) {
  constexpr double kDeviationShare = 1e-3;  // of the longest side, by default
  const double deviation =
      options.deviation_m == 0.0 ? kDeviationShare * longest_side_m(scene.scene->mesh()) : options.deviation_m;
  if (!positive(options.angle_deg) || !positive(deviation) || !positive(options.aspect))
    return fail_with(coarse, {"angle_deg, deviation_m and aspect have to be positive numbers",
                              "tangent_decimate_options", "deviation_m 0 stands for a thousandth of the size"});
  DecimateResult made = decimate(*scene.scene, {options.angle_deg, deviation, options.aspect});
  ContactMeshOptions as_is;
  as_is.normals = NormalSource::file;
  Result<ContactMesh> mesh = ContactMesh::build(made.mesh, as_is);
  if (!mesh) return fail_with(coarse, mesh.error());
  Result<std::shared_ptr<const ContactScene>> built = ContactScene::build(std::move(*mesh));
  if (!built) return fail_with(coarse, built.error());
  coarse.scene = std::move(*built);
  coarse.source = std::make_shared<const PolygonMesh>(std::move(made.mesh));
  return TANGENT_OK;
}

}  // namespace
}  // namespace tangent::c

using namespace tangent;

tangent_status tangent_audit(tangent_scene* scene, tangent_mesh_audit* audit) {
  if (scene == nullptr || audit == nullptr || !scene->scene) return TANGENT_NULL;
  return c::run_guarded(*scene, [&] {
    if (!scene->source) return c::fail_with(*scene, c::needs_mesh("tangent_audit"));
    if (const tangent_status size = c::check_size(*scene, *audit, "tangent_mesh_audit"); size != TANGENT_OK)
      return size;
    c::write_audit(audit_mesh(*scene->source, scene->scene->mesh()), *audit);
    return TANGENT_OK;
  });
}

tangent_status tangent_decimate(const tangent_scene* scene, const tangent_decimate_options* options,
                                tangent_scene** coarse) {
  if (scene == nullptr || !scene->scene) {
    if (coarse != nullptr) *coarse = nullptr;
    return TANGENT_NULL;
  }
  return c::make_handle(TANGENT_C_VERSION, coarse, [&](tangent_scene& handle) {
    static constexpr tangent_decimate_options kDefaults = TANGENT_DECIMATE_OPTIONS_INIT;
    const tangent_decimate_options& given = options ? *options : kDefaults;
    if (const tangent_status size = c::check_size(handle, given, "tangent_decimate_options"); size != TANGENT_OK)
      return size;
    if (!scene->source) return c::fail_with(handle, c::needs_mesh("tangent_decimate"));
    return c::decimate_to(*scene, given, handle);
  });
}
