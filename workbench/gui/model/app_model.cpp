#include "workbench/gui/model/app_model.h"

#include <utility>

namespace tangent {

namespace {

constexpr double kLastWait_s = 1.0;  ///< for another window's lock, where there is no next time

}  // namespace

AppModel::AppModel(const AppOptions& options)
    : options_(options),
      window_(options_, messages_),
      presets_(options_, messages_, [this](const std::string& what) { preset_changed(what); }),
      scene_(options_, presets_, messages_, [this](SceneChange change) { scene_loaded(std::move(change)); }),
      view_(scene_, map_, messages_),
      devices_(options_, scene_, presets_, messages_, [this] { time_.forget(); }),
      time_(options_, devices_, presets_, messages_),
      tuning_(options_, presets_, time_, messages_),
      why_(options_, time_, presets_, view_, scene_, messages_),
      recordings_(options_, presets_, messages_),
      unsaved_(options_, presets_, time_, messages_),
      exports_(options_, devices_, messages_) {
  if (const auto look = window_.read_settings()) {
    view_.camera.y_up = look->y_up;
    map_.colours = look->colours;
  }
  presets_.refresh_files();
  if (!options_.preset.empty()) presets_.load(options_.preset);
  if (!options_.record.empty())
    messages_.say(Severity::warning,
                  "recording to a file is not there yet; " + options_.record.string() + " is not written");
  scene_.open_first(options_.mesh);
}

AppModel::~AppModel() {
  devices_.end_session();  // no force while a file is waited for
  window_.keep_settings(kept_look(), kLastWait_s);
}

const ContactMesh* AppModel::mesh() const {
  const ContactScene* scene = scene_.current().get();
  return scene != nullptr && scene->planar() == nullptr ? &scene->mesh() : nullptr;
}

void AppModel::open(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".toml")
    presets_.load(file, mesh());
  else
    scene_.open(file);
}

void AppModel::solve_here(std::uint32_t triangle, double u, double v) {
  const MapOptions& how = map_.options;
  if (time_.solve_at(scene_.current(), triangle, u, v, {how.directions, how.press_m, how.move_m}))
    view_.toggles.planes = true;
}

void AppModel::solve_here() {
  const ContactMesh* mesh = this->mesh();
  if (mesh == nullptr) return;
  if (view_.picked_triangle < mesh->triangle_count()) return solve_here(view_.picked_triangle, 1.0 / 3.0, 1.0 / 3.0);
  const ServoRecord* record = time_.tick().record();
  if (record == nullptr || time_.scene_of_tick() != scene_.current() || record->tick.output.triangle == kNone)
    return messages_.say(Severity::note, "click a triangle to solve there");
  const TickOutput& out = record->tick.output;
  solve_here(out.triangle, out.u, out.v);
}

void AppModel::solve_at_worst() {
  if (const MapPlace* place = view_.look_at_worst()) solve_here(place->triangle, place->u, place->v);
}

void AppModel::keep() {
  window_.keep_settings(kept_look(), kLastWait_s);
  unsaved_.keep();
}

void AppModel::update(double now_s) {
  messages_.set_now(now_s);
  scene_.update();
  take_ticks();
  view_.see_contact(tick_in_view(), time_.paused());
  window_.update(now_s, kept_look());
  unsaved_.update(now_s);
  recordings_.update();
  const auto& scene = scene_.current();
  // A 2D scene has no mesh for a map.
  map_.update(scene != nullptr && scene->planar() != nullptr ? nullptr : scene, presets_.current(), now_s,
              presets_.slots().gesture_open(), options_.deterministic);
}

const TickRecord* AppModel::tick_in_view() const {
  const ServoRecord* record = time_.tick().record();
  return record != nullptr ? &record->tick : nullptr;
}

void AppModel::advance(std::uint64_t ticks) {
  if (devices_.session() == nullptr || !options_.deterministic) return;
  devices_.session()->advance(ticks);
  take_ticks();
}

void AppModel::take_ticks() {
  exports_.take_finished();
  if (devices_.session() == nullptr) return;
  time_.take_records();
  devices_.take_status();
  time_.show_tick();
  tuning_.update();
}

void AppModel::scene_loaded(SceneChange change) {
  if (change.opened) {
    window_.opened(scene_.path());
    view_.look_at_new_scene();
  }
  devices_.take_scene(std::move(change.prepared));
}

void AppModel::preset_changed(const std::string& what) {
  const auto id = devices_.send_preset();
  if (!id) return;
  presets_.note_sent(*id, what);
  time_.preset_sent();
}

}  // namespace tangent
