// The C interface: scenes.
#include "core/io/mesh_io.h"
#include "core/io/scene_file.h"
#include "workbench/embed/c_handle.h"

#include <cmath>
#include <numbers>

namespace tangent::c {
namespace {

Status check_options(const tangent_scene_options& options) {
  if (!(options.metres_per_unit > 0.0 && std::isfinite(options.metres_per_unit)))
    return fail("metres_per_unit is not a positive number", "tangent_scene_options", "millimetres are 1e-3");
  if (!(options.fit_m >= 0.0 && std::isfinite(options.fit_m)))
    return fail("fit_m is negative or no number", "tangent_scene_options", "0 leaves the mesh as it is");
  if (!(options.crease_rad >= 0.0 && options.crease_rad <= std::numbers::pi))
    return fail("crease_rad is not within 0 to pi", "tangent_scene_options", "45 degrees are 0.785");
  if (options.normals > 2)
    return fail("normals is not 0, 1 or 2", "tangent_scene_options", "0 takes the file's if any");
  return {};
}

SceneOptions options_of(const tangent_scene_options& given) {
  SceneOptions options;
  options.metres_per_unit = given.metres_per_unit;
  if (given.fit_m > 0.0) options.mesh.fit_m = given.fit_m;
  options.mesh.normals = static_cast<NormalSource>(given.normals);
  options.mesh.crease_rad = given.crease_rad;
  options.mesh.turn_over = given.turn_over != 0;
  return options;
}

tangent_status load(tangent_scene& handle, const char* path, const tangent_scene_options& options) {
  if (const Status status = check_options(options); !status) return fail_with(handle, status.error());
  Result<SceneFile> file = read_scene(path, options_of(options));
  if (!file) return fail_with(handle, file.error());
  handle.scene = std::move(file->scene);
  handle.source = std::move(file->source);
  return TANGENT_OK;
}

}  // namespace
}  // namespace tangent::c

using namespace tangent;

tangent_status tangent_load_scene(uint32_t version, const char* path, const tangent_scene_options* options,
                                  tangent_scene** scene) {
  return c::make_handle(version, scene, [&](tangent_scene& handle) {
    if (path == nullptr)
      return c::fail_with(handle, {"path is null", "tangent_load_scene", "name a file"}, TANGENT_NULL);
    static constexpr tangent_scene_options kDefaults = TANGENT_SCENE_OPTIONS_INIT;
    const tangent_scene_options& given = options ? *options : kDefaults;
    if (const tangent_status size = c::check_size(handle, given, "tangent_scene_options"); size != TANGENT_OK)
      return size;
    return c::load(handle, path, given);
  });
}

tangent_status tangent_get_scene_info(const tangent_scene* scene, tangent_scene_info* info) {
  if (scene == nullptr || info == nullptr || !scene->scene) return TANGENT_NULL;
  if (info->size != sizeof(tangent_scene_info)) return TANGENT_BAD_SIZE;
  const ContactScene& built = *scene->scene;
  const ContactMesh& mesh = built.mesh();
  info->planar = built.planar() != nullptr;
  info->triangles = mesh.triangle_count();
  info->usable_triangles = mesh.usable_triangle_count();
  info->vertices = mesh.vertex_count();
  info->content_hash = mesh.content_hash();
  info->memory_bytes = built.memory_bytes();
  c::copy_vector(mesh.origin() + mesh.bounds().min, info->box_min_m);
  c::copy_vector(mesh.origin() + mesh.bounds().max, info->box_max_m);
  return TANGENT_OK;
}

tangent_status tangent_write_mesh(tangent_scene* scene, const char* path, double metres_per_unit) {
  if (scene == nullptr || path == nullptr) return TANGENT_NULL;
  return c::run_guarded(*scene, [&] {
    if (!scene->source)
      return c::fail_with(*scene, {"this scene has no mesh to write", path, "write the mesh of a 3D scene"});
    if (!(metres_per_unit > 0.0 && std::isfinite(metres_per_unit)))
      return c::fail_with(*scene, {"metres_per_unit is not a positive number", path, "millimetres are 1e-3"});
    const Status written = write_obj(*scene->source, path, metres_per_unit);
    return written ? TANGENT_OK : c::fail_with(*scene, written.error());
  });
}

const char* tangent_scene_error(const tangent_scene* scene) {
  return scene ? scene->error.get() : tangent_status_text(TANGENT_NULL);
}

void tangent_free_scene(tangent_scene* scene) { delete scene; }
