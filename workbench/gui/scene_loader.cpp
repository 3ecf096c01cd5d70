#include "workbench/gui/scene_loader.h"

#include "core/mesh/generate.h"
#include "core/mesh/mesh_io.h"

#include <algorithm>
#include <chrono>

namespace tangent {

namespace {

template <class T>
bool ready(const std::future<T>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

Result<PolygonMesh> read_or_generate(const SceneRequest& request) {
  const auto& names = generator_names();
  if (std::find(names.begin(), names.end(), request.mesh) != names.end()) return generate_mesh(request.mesh);
  return read_mesh(request.mesh, request.metres_per_unit);
}

}  // namespace

Result<LoadedScene> load_scene(const SceneRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  auto polygons = read_or_generate(request);
  if (!polygons) return tl::unexpected(polygons.error());
  auto mesh = ContactMesh::build(*polygons, request.options);
  if (!mesh) return tl::unexpected(mesh.error());
  auto scene = ContactScene::build(std::move(*mesh));
  if (!scene) return tl::unexpected(scene.error());
  LoadedScene out;
  out.polygons = std::make_shared<const PolygonMesh>(std::move(*polygons));
  out.scene = std::move(*scene);
  out.prepared = Session::prepare(out.scene, request.finger);
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

void SceneLoader::request(SceneRequest request) {
  name_ = request.mesh;
  waiting_ = std::move(request);
}

std::optional<Result<LoadedScene>> SceneLoader::poll() {
  std::optional<Result<LoadedScene>> out;
  if (ready(loading_)) {
    out = loading_.get();
    // Something else was asked for meanwhile: this one is late.
    if (waiting_) out.reset();
  }
  if (!loading_.valid() && waiting_) {
    loading_ = std::async(std::launch::async, [request = std::move(*waiting_)] { return load_scene(request); });
    waiting_.reset();
  }
  return out;
}

void SceneLoader::request_audit(std::shared_ptr<const PolygonMesh> polygons, std::shared_ptr<const ContactScene> scene) {
  audit_waiting_ = {std::move(polygons), std::move(scene)};
}

std::optional<MeshAudit> SceneLoader::poll_audit() {
  std::optional<MeshAudit> out;
  if (ready(audit_)) {
    out = audit_.get();
    if (audit_waiting_.scene != nullptr) out.reset();
  }
  if (!audit_.valid() && audit_waiting_.scene != nullptr) {
    audit_ = std::async(std::launch::async, [request = std::move(audit_waiting_)] {
      return audit_mesh(*request.polygons, request.scene->mesh());
    });
    audit_waiting_ = {};
  }
  return out;
}

}  // namespace tangent
