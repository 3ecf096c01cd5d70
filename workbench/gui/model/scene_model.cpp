#include "workbench/gui/model/scene_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace tangent {

namespace {

constexpr const char* kBuiltInScene = "torus";

}  // namespace

SceneModel::SceneModel(const AppOptions& options, const PresetModel& presets, MessageLog& messages,
                       std::function<void(SceneChange)> changed)
    : presets_(presets),
      messages_(messages),
      changed_(std::move(changed)),
      deterministic_(options.deterministic),
      metres_per_unit_(options.metres_per_unit),
      mesh_options_(options.mesh_options) {}

void SceneModel::open_first(const std::string& mesh) {
  open(mesh.empty() ? kBuiltInScene : mesh);
  if (scene_ == nullptr && !loader_.busy()) open(kBuiltInScene);
}

void SceneModel::open(const std::string& mesh) {
  opening_path_ = mesh;
  load(nullptr);
}

SceneSource SceneModel::source() const {
  if (scene_->planar() != nullptr) return source_of_planar(*scene_);
  return {polygons_, built_with_, nullptr};
}

void SceneModel::show(LoadedScene loaded, const ContactMeshOptions& options) {
  opening_path_.clear();
  mesh_options_ = options;
  loaded.options = options;
  take(std::move(loaded));
}

/// `polygons`: already read.
void SceneModel::load(std::shared_ptr<const PolygonMesh> polygons) {
  SceneRequest request{opening_path_, metres_per_unit_, mesh_options_, presets_.current().finger, std::move(polygons)};
  if (!deterministic_) {
    loader_.request(std::move(request));
    return;
  }
  auto loaded = load_scene(request);
  if (!loaded)
    messages_.say(Severity::error, loaded.error().message());
  else
    take(std::move(*loaded));
}

void SceneModel::update() {
  if (auto loaded = loader_.poll()) {
    if (*loaded) {
      take(std::move(**loaded));
    } else {
      messages_.say(Severity::error, loaded->error().message());
      if (scene_ == nullptr && opening_path_ != kBuiltInScene) open(kBuiltInScene);
    }
  }
  if (auto report = loader_.poll_audit()) report_ = std::move(*report);
}

void SceneModel::take(LoadedScene loaded) {
  scene_ = std::move(loaded.scene);
  polygons_ = std::move(loaded.polygons);
  load_seconds_ = loaded.seconds;
  built_with_ = loaded.options;
  report_.reset();
  if (!loaded.rebuilt) {
    path_ = opening_path_;
    warn_of_left_out();
    warn_of_size();
  }
  for (const std::string& note : scene_->mesh().notes()) messages_.say(Severity::note, note);
  changed_({std::move(loaded.prepared), !loaded.rebuilt});
  if (deterministic_)
    report_ = report_on(*polygons_, scene_->mesh());
  else
    loader_.request_audit(polygons_, scene_);
}

void SceneModel::set_unit(double metres_per_unit) {
  if (metres_per_unit == metres_per_unit_) return;
  metres_per_unit_ = metres_per_unit;
  if (!path_.empty()) open(path_);
}

void SceneModel::set_fit(std::optional<double> fit_m) {
  if (fit_m && !(*fit_m >= 1e-6 && *fit_m <= 1e6))
    return messages_.say(Severity::error, "the longest side must be 0.001 to 1000000000 mm");
  if (fit_m == mesh_options_.fit_m) return;
  mesh_options_.fit_m = fit_m;
  if (!path_.empty()) open(path_);
}

void SceneModel::set_crease_angle(double rad) {
  if (!std::isfinite(rad) || polygons_ == nullptr || scene_->planar() != nullptr) return;
  rad = std::clamp(rad, 0.0, 180.0 * kDegree);
  if (rad == mesh_options_.crease_rad) return;
  mesh_options_.crease_rad = rad;
  opening_path_ = path_;
  load(polygons_);
}

/// Before every other message: a mesh of which much is missing is not the one that was meant.
void SceneModel::warn_of_left_out() {
  if (scene_->planar() != nullptr) return;
  const ContactMesh& mesh = scene_->mesh();
  const std::uint32_t all = mesh.triangle_count(), used = mesh.usable_triangle_count();
  if (used == all) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "%u of %u triangles are left out: no area, no finite corner, or there already. The surface has holes "
                "there; the panel Inspect lists them",
                all - used, all);
  messages_.say(10 * (all - used) > all ? Severity::warning : Severity::note, text);
}

/// Mesh files do not state their unit: one in metres read as millimetres would be 1000 times too small.
void SceneModel::warn_of_size() {
  const Vec3 size = scene_->mesh().bounds().size();
  const double longest = std::max({size.x, size.y, size.z}), finger = 2.0 * presets_.current().finger.reach_m();
  if (finger <= 0.0 || (longest > 0.05 * finger && longest < 200.0 * finger)) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "the mesh is %.3g mm long and the finger %.3g mm: Unit of the file and Longest side in the panel Mesh "
                "change that",
                longest * 1e3, finger * 1e3);
  messages_.say(Severity::warning, text);
}

}  // namespace tangent
