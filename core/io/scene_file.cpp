#include "core/io/scene_file.h"

#include "core/base/float_state.h"
#include "core/io/mesh_io.h"
#include "core/io/polygon_io.h"

#include <utility>

namespace tangent {
namespace {

using Scene = Result<std::shared_ptr<const ContactScene>>;

/// The error of a step that doesn't know the file.
tl::unexpected<Error> at_file(Error error, const std::filesystem::path& path) {
  if (error.where.empty()) error.where = path.string();
  return tl::unexpected<Error>(std::move(error));
}

Scene load_planar(const std::filesystem::path& path, const SceneOptions& options) {
  Result<PlanarPolygon> polygon = read_polygon(path, options.metres_per_unit);
  if (!polygon) return at_file(polygon.error(), path);
  if (options.mesh.fit_m) fit_polygon(*polygon, *options.mesh.fit_m);
  Result<PlanarCurve> curve = PlanarCurve::build(std::move(*polygon));
  if (!curve) return at_file(curve.error(), path);
  return ContactScene::build(std::move(*curve), options.parts);
}

}  // namespace

Result<SceneFile> read_scene(const std::filesystem::path& path, const SceneOptions& options, const RunBoth& run_both) {
  return read_scene(path, options, run_both, BesideContent{});
}

Result<SceneFile> read_scene(const std::filesystem::path& path, const SceneOptions& options, const RunBoth& run_both,
                             const BesideContent& beside) {
  const FloatState as_tested;
  if (is_planar_file(path)) {
    Scene planar = load_planar(path, options);
    if (!planar) return tl::unexpected(planar.error());
    return SceneFile{std::move(*planar), nullptr};
  }
  Result<PolygonMesh> source = read_mesh(path, options.metres_per_unit, run_both);
  if (!source) return at_file(source.error(), path);
  Result<ContactMesh> mesh = ContactMesh::build(*source, options.mesh, run_both, beside.begin);
  if (!mesh) return at_file(mesh.error(), path);
  if (beside.end && !ContactScene::is_in_parts(*mesh, options.parts)) beside.end();
  Scene scene = ContactScene::build(std::move(*mesh), options.parts, run_both);
  if (!scene) return at_file(scene.error(), path);
  return SceneFile{std::move(*scene), std::make_shared<const PolygonMesh>(std::move(*source))};
}

Scene load_scene(const std::filesystem::path& path, const SceneOptions& options, const RunBoth& run_both) {
  Result<SceneFile> file = read_scene(path, options, run_both);
  if (!file) return tl::unexpected(file.error());
  return std::move(file->scene);
}

}  // namespace tangent
