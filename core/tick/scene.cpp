#include "core/tick/scene.h"

#include "core/planar/ribbon.h"

namespace tangent {

Result<std::shared_ptr<const ContactScene>> ContactScene::build(ContactMesh mesh) {
  return with_queries(std::shared_ptr<ContactScene>(new ContactScene(std::move(mesh))));
}

Result<std::shared_ptr<const ContactScene>> ContactScene::build(PlanarCurve curve) {
  constexpr double kRibbonShare = 0.1;  // half its width, in sizes of the polygon
  ContactMeshOptions options;
  options.normals = NormalSource::file;
  auto mesh = ContactMesh::build(ribbon(curve, kRibbonShare * curve.size_m()), options);
  if (!mesh) return tl::unexpected(mesh.error());
  std::shared_ptr<ContactScene> scene(new ContactScene(std::move(*mesh)));
  scene->planar_ = std::make_unique<const PlanarCurve>(std::move(curve));
  return with_queries(std::move(scene));
}

Result<std::shared_ptr<const ContactScene>> ContactScene::with_queries(std::shared_ptr<ContactScene> scene) {
  auto nearest = NearestTriangles::build(scene->mesh_);
  if (!nearest) return tl::unexpected(nearest.error());
  scene->nearest_ = std::make_unique<NearestTriangles>(std::move(*nearest));
  scene->hierarchy_ = ContactHierarchy::build(scene->mesh_);
  return scene;
}

std::size_t ContactScene::memory_bytes() const {
  return mesh_.memory_bytes() + nearest_->memory_bytes() + hierarchy_.memory_bytes();
}

}  // namespace tangent
