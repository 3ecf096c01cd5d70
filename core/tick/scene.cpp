#include "core/tick/scene.h"

#include "core/base/float_state.h"
#include "core/planar/ribbon.h"
#include "core/tick/sources.h"

namespace tangent {

SceneParts parts_for(const Preset& preset) { return {.hierarchy = wants_smooth(preset), .ribbon = false}; }

Result<std::shared_ptr<const ContactScene>> ContactScene::build(ContactMesh mesh, const SceneParts& parts,
                                                                const RunBoth& run_both) {
  const FloatState as_tested;
  std::shared_ptr<ContactScene> scene(new ContactScene);
  scene->mesh_.emplace(std::move(mesh));
  std::optional<Result<NearestTriangles>> nearest;
  const auto build_nearest = [&] { nearest.emplace(NearestTriangles::build(*scene->mesh_)); };
  if (parts.hierarchy) {
    run_both(build_nearest, [&] { scene->hierarchy(); });
  } else {
    build_nearest();
  }
  if (!*nearest) return tl::unexpected(nearest->error());
  scene->nearest_ = std::make_unique<NearestTriangles>(std::move(**nearest));
  return scene;
}

Result<std::shared_ptr<const ContactScene>> ContactScene::build(PlanarCurve curve, const SceneParts& parts) {
  const FloatState as_tested;
  constexpr double kRibbonShare = 0.1;  // half its width, in sizes of the polygon
  std::shared_ptr<ContactScene> scene(new ContactScene);
  if (parts.ribbon) {
    ContactMeshOptions options;
    options.normals = NormalSource::file;
    auto mesh = ContactMesh::build(ribbon(curve, kRibbonShare * curve.size_m()), options);
    if (!mesh) return tl::unexpected(mesh.error());
    scene->mesh_.emplace(std::move(*mesh));
    auto nearest = NearestTriangles::build(*scene->mesh_);
    if (!nearest) return tl::unexpected(nearest.error());
    scene->nearest_ = std::make_unique<NearestTriangles>(std::move(*nearest));
  }
  scene->planar_ = std::make_unique<const PlanarCurve>(std::move(curve));
  return scene;
}

std::size_t ContactScene::memory_bytes() const {
  const ContactHierarchy* hierarchy = hierarchy_.if_built();
  return (mesh_ ? mesh_->memory_bytes() : 0) + (nearest_ ? nearest_->memory_bytes() : 0) +
         (hierarchy ? hierarchy->memory_bytes() : 0) + (planar_ ? planar_->memory_bytes() : 0);
}

}  // namespace tangent
