#include "workbench/gui/model/scene_loader.h"

#include "core/io/mesh_io.h"
#include "core/io/polygon_io.h"
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generate_hard.h"
#include "core/planar/ribbon.h"
#include "workbench/session/parts_builder.h"
#include "workbench/session/prepared_scene.h"
#include "workbench/session/two_threads.h"

#include <algorithm>
#include <chrono>

namespace tangent {

namespace {

template <class T>
bool ready(const std::future<T>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

Result<PolygonMesh> read_or_generate(const SceneRequest& request) {
  for (const auto* names : {&generator_names(), &hard_mesh_names()}) {
    if (std::find(names->begin(), names->end(), request.mesh) != names->end()) return generate_mesh(request.mesh);
  }
  return read_mesh(request.mesh, request.metres_per_unit, run_on_two_threads);
}

/// Loads a polygon as a 2D scene. Its mesh is the ribbon that the scene builds from it.
Result<LoadedScene> load_planar(const SceneRequest& request) {
  auto polygon = read_polygon(request.mesh, request.metres_per_unit);
  if (!polygon) return tl::unexpected(polygon.error());
  if (request.options.fit_m) fit_polygon(*polygon, *request.options.fit_m);
  auto curve = PlanarCurve::build(std::move(*polygon));
  if (!curve) return tl::unexpected(curve.error());
  LoadedScene out;
  out.polygons = std::make_shared<const PolygonMesh>(ribbon(*curve, 0.1 * curve->size_m()));
  auto scene = ContactScene::build(std::move(*curve));
  if (!scene) return tl::unexpected(scene.error());
  out.scene = std::move(*scene);
  out.prepared = Session::prepare(out.scene, request.finger);
  return out;
}

}  // namespace

MeshReport report_on(const PolygonMesh& polygons, const ContactMesh& mesh) {
  return {audit_mesh(polygons, mesh), find_defects(polygons, mesh), audit_perception(mesh, facet_angles(mesh))};
}

std::shared_ptr<const PolygonMesh> polygons_of(const ContactScene& scene, std::shared_ptr<const PolygonMesh> polygons) {
  const PlanarCurve* curve = scene.planar();
  if (curve == nullptr || polygons != nullptr) return polygons;
  return std::make_shared<const PolygonMesh>(ribbon(*curve, 0.1 * curve->size_m()));
}

LoadedScene load_built(std::shared_ptr<const ContactScene> scene, std::shared_ptr<const PolygonMesh> polygons,
                       const Finger& finger) {
  LoadedScene out;
  out.polygons = polygons_of(*scene, std::move(polygons));
  out.prepared = Session::prepare(scene, finger);
  if (scene->planar() == nullptr)
    build_in_reach(*scene, out.prepared->path.at(0.0, pad_distance_m(finger), 0.0).position_m, finger);
  out.scene = std::move(scene);
  return out;
}

Result<LoadedScene> load_scene(const SceneRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  if (request.polygons == nullptr && is_planar_file(request.mesh)) {
    auto planar = load_planar(request);
    if (planar) planar->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return planar;
  }
  LoadedScene out;
  out.options = request.options;
  out.rebuilt = request.polygons != nullptr;
  out.polygons = request.polygons;
  if (!out.rebuilt) {
    auto read = read_or_generate(request);
    if (!read) return tl::unexpected(read.error());
    out.polygons = std::make_shared<const PolygonMesh>(std::move(*read));
  }
  auto mesh = ContactMesh::build(*out.polygons, request.options, run_on_two_threads);
  if (!mesh) return tl::unexpected(mesh.error());
  // What is far from the finger the session builds beside its servo.
  auto scene = ContactScene::build(std::move(*mesh), {.far_parts = false}, run_on_two_threads);
  if (!scene) return tl::unexpected(scene.error());
  out.scene = std::move(*scene);
  out.prepared = Session::prepare(out.scene, request.finger);
  build_in_reach(*out.scene, out.prepared->path.at(0.0, pad_distance_m(request.finger), 0.0).position_m,
                 request.finger);
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
    // A newer request is waiting: this result is outdated.
    if (waiting_) out.reset();
  }
  if (!loading_.valid() && waiting_) {
    loading_ = std::async(std::launch::async, [request = std::move(*waiting_)] { return load_scene(request); });
    waiting_.reset();
  }
  return out;
}

void SceneLoader::request_audit(std::shared_ptr<const PolygonMesh> polygons,
                                std::shared_ptr<const ContactScene> scene) {
  audit_waiting_ = {std::move(polygons), std::move(scene)};
}

std::optional<MeshReport> SceneLoader::poll_audit() {
  std::optional<MeshReport> out;
  if (ready(audit_)) {
    out = audit_.get();
    if (audit_waiting_.scene != nullptr) out.reset();
  }
  if (!audit_.valid() && audit_waiting_.scene != nullptr) {
    audit_ = std::async(std::launch::async, [request = std::move(audit_waiting_)] {
      return report_on(*request.polygons, request.scene->mesh());
    });
    audit_waiting_ = {};
  }
  return out;
}

}  // namespace tangent
