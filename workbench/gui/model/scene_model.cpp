#include "workbench/gui/model/scene_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace tangent {

namespace {

constexpr const char* kBuiltInScene = "torus";

/// The same camera and the same triangle numbers go with both.
bool same_triangles(const ContactScene& a, const ContactScene& b) {
  const ContactMesh &one = a.mesh(), &other = b.mesh();
  return (a.planar() == nullptr) == (b.planar() == nullptr) && one.origin() == other.origin() &&
         one.bounds().min == other.bounds().min && one.bounds().max == other.bounds().max &&
         one.triangle_count() == other.triangle_count();
}

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
  if (shown_.scene == nullptr && !loader_.busy()) open(kBuiltInScene);
}

void SceneModel::open(const std::string& mesh) {
  opening_path_ = mesh;
  load(nullptr);
}

SceneSource SceneModel::source() const {
  const Shown& own = own_ ? *own_ : shown_;
  if (own.scene->planar() != nullptr) return source_of_planar(*own.scene);
  return {own.polygons, own.built_with, nullptr};
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
      if (shown_.scene == nullptr && opening_path_ != kBuiltInScene) open(kBuiltInScene);
    }
  }
  if (auto report = loader_.poll_audit()) report_ = std::move(*report);
}

void SceneModel::take(LoadedScene loaded) {
  own_.reset();
  shown_.scene = std::move(loaded.scene);
  shown_.polygons = std::move(loaded.polygons);
  shown_.load_seconds = loaded.seconds;
  shown_.built_with = loaded.options;
  report_.reset();
  if (!loaded.rebuilt) {
    shown_.path = opening_path_;
    warn_of_left_out();
    warn_of_size();
  }
  for (const std::string& note : shown_.scene->mesh().notes()) messages_.say(Severity::note, note);
  changed(std::move(loaded.prepared), !loaded.rebuilt);
}

void SceneModel::changed(PreparedScenePtr prepared, bool opened) {
  changed_({std::move(prepared), opened});
  if (shown_.polygons == nullptr) return;  // a scene whose faces are not known: nothing to audit
  if (deterministic_)
    report_ = report_on(*shown_.polygons, shown_.scene->mesh());
  else
    loader_.request_audit(shown_.polygons, shown_.scene);
}

void SceneModel::look_at(const std::shared_ptr<const ContactScene>& scene, const SceneSource* source) {
  if (scene == nullptr || scene == shown_.scene) return;
  const std::shared_ptr<const ContactScene> before = shown_.scene;
  if (scene == of_servo()) {
    shown_ = *std::exchange(own_, std::nullopt);
    mesh_options_ = shown_.import;
  } else {
    if (!own_ && before != nullptr) {
      own_ = shown_;
      own_->import = mesh_options_;
    }
    shown_ = {};
    shown_.scene = scene;
    shown_.polygons = polygons_of(*scene, source != nullptr ? source->mesh : nullptr);
    if (source != nullptr) mesh_options_ = shown_.built_with = source->options;
  }
  report_.reset();
  changed(nullptr, before == nullptr || !same_triangles(*before, *scene));
}

void SceneModel::set_unit(double metres_per_unit) {
  if (metres_per_unit == metres_per_unit_) return;
  metres_per_unit_ = metres_per_unit;
  if (!shown_.path.empty()) open(shown_.path);
}

void SceneModel::set_fit(std::optional<double> fit_m) {
  if (fit_m && !(*fit_m >= 1e-6 && *fit_m <= 1e6))
    return messages_.say(Severity::error, "the longest side must be 0.001 to 1000000000 mm");
  if (fit_m == mesh_options_.fit_m) return;
  mesh_options_.fit_m = fit_m;
  if (!shown_.path.empty()) open(shown_.path);
}

void SceneModel::set_crease_angle(double rad) {
  if (!std::isfinite(rad) || shown_.polygons == nullptr || shown_.scene->planar() != nullptr) return;
  rad = std::clamp(rad, 0.0, 180.0 * kDegree);
  if (rad == mesh_options_.crease_rad) return;
  mesh_options_.crease_rad = rad;
  opening_path_ = shown_.path;
  load(shown_.polygons);
}

/// Before every other message: a mesh of which much is missing is not the one that was meant.
void SceneModel::warn_of_left_out() {
  if (shown_.scene->planar() != nullptr) return;
  const ContactMesh& mesh = shown_.scene->mesh();
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
  const Vec3 size = shown_.scene->mesh().bounds().size();
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
