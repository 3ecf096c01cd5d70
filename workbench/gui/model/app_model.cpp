#include "workbench/gui/model/app_model.h"

#include "workbench/session/maestro_setups.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <thread>

namespace tangent {

namespace {

/// As many ticks as the session keeps.
std::size_t plotted_ticks(double history_s, double servo_hz) {
  return static_cast<std::size_t>(
      std::min(history_s * servo_hz, static_cast<double>(kLargestHistoryBytes / sizeof(ServoRecord))));
}
constexpr const char* kBuiltInScene = "torus";
constexpr double kSettingsEvery_s = 2.0;
constexpr std::size_t kMostPresetNotes = 4096;  // a dragged slider sends one preset a frame

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &local);
  return text;
}

std::string hex16(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace

AppModel::AppModel(const AppOptions& options)
    : options_(options),
      store_(kChannelCount, plotted_ticks(options.history_s, options.servo_hz)),
      time_machine_(options.deterministic ? 0u : std::max(1u, std::thread::hardware_concurrency())),
      theme_(options.theme) {
  if (!options_.screenshots.empty()) export_folder_ = options_.screenshots;
  preset_folder_ = options_.preset_folder;
  // A preset brings its neighbours with it.
  if (preset_folder_.empty() && options_.preset.has_parent_path()) preset_folder_ = options_.preset.parent_path();
  if (preset_folder_.empty())
    preset_folder_ = options_.preset.empty() ? std::filesystem::path(TANGENT_PRESET_DIR) : ".";
  take_settings();
  refresh_preset_files();
  if (!options_.preset.empty()) load_preset(options_.preset);
  if (!options_.record.empty())
    say(Severity::warning, "recording to a file is not there yet; " + options_.record.string() + " is not written");
  open_mesh(options_.mesh.empty() ? kBuiltInScene : options_.mesh);
  if (scene_ == nullptr && !loader_.busy()) open_mesh(kBuiltInScene);
}

AppModel::~AppModel() { keep_settings(); }

void AppModel::update(double now_s) {
  now_s_ = now_s;
  if (auto loaded = loader_.poll()) {
    if (*loaded) {
      take_scene(std::move(**loaded));
    } else {
      say(Severity::error, loaded->error().message());
      if (scene_ == nullptr && opening_path_ != kBuiltInScene) open_mesh(kBuiltInScene);
    }
  }
  if (auto report = loader_.poll_audit()) report_ = std::move(*report);
  take_records();
  show_tick();
  if (now_s_ - settings_looked_at_s_ > kSettingsEvery_s) keep_settings();
  // A 2D scene has no mesh to lay a map on.
  map_.update(scene_ != nullptr && scene_->planar() != nullptr ? nullptr : scene_, presets().current(), now_s_,
              slots_.gesture_open(), options_.deterministic);
}

void AppModel::advance(std::uint64_t ticks) {
  if (session_ == nullptr || !options_.deterministic) return;
  session_->advance(ticks);
  take_records();
  show_tick();
}

void AppModel::open_mesh(const std::string& mesh) {
  opening_path_ = mesh;
  SceneRequest request{mesh, options_.metres_per_unit, options_.mesh_options, presets().current().finger, nullptr};
  if (!options_.deterministic) {
    loader_.request(std::move(request));
    return;
  }
  auto loaded = load_scene(request);
  if (!loaded)
    say(Severity::error, loaded.error().message());
  else
    take_scene(std::move(*loaded));
}

void AppModel::take_scene(LoadedScene loaded) {
  scene_ = std::move(loaded.scene);
  polygons_ = std::move(loaded.polygons);
  load_seconds_ = loaded.seconds;
  report_.reset();
  if (!loaded.rebuilt) {
    mesh_path_ = opening_path_;
    settings_.opened(mesh_path_);
    worst_shown_ = 0;
    view_.picked_triangle = view_.hovered_triangle = kNone;
    view_.isolation.reset();
    view_.slice.reset();
    inspection_ = {};
    frame_scene();
    warn_of_size();
  }
  for (const std::string& note : scene_->mesh().notes()) say(Severity::note, note);
  if (session_ != nullptr)
    session_->set_scene(std::move(loaded.prepared));
  else
    make_session();
  if (options_.deterministic)
    report_ = report_on(*polygons_, scene_->mesh());
  else
    loader_.request_audit(polygons_, scene_);
}

std::filesystem::path AppModel::maestro_file() const {
  return options_.settings.empty() ? std::filesystem::path() : options_.settings.parent_path() / kMaestroFile;
}

void AppModel::make_session() {
  if (options_.device == "maestro") {
    const auto setup = chosen_maestro_setup(options_.maestro, maestro_file());
    if (!setup) return say(Severity::error, setup.error().message());
    maestro_ = *setup;
  }
  SessionOptions options;
  options.servo.rate_hz = options_.servo_hz;
  options.devices = options_.device;
  options.maestro = maestro_.calibration;
  options.maestro_channel = maestro_.channel;
  options.packets = options_.packets;
  options.seed = options_.seed;
  options.history_s = options_.history_s;
  options.threaded = !options_.deterministic;
  auto session = Session::create(scene_, presets().current(), options);
  if (!session) {
    say(Severity::error, session.error().message());
    return;
  }
  session_ = std::move(*session);
  session_->start();
  status_ = session_->status();
}

void AppModel::set_device(const std::string& name) {
  if (name == options_.device && session_ != nullptr) return;
  options_.device = name;
  restart_session();
}

void AppModel::calibrate_maestro(const MaestroCalibration& calibration, unsigned channel) {
  if (const Status ok = check_calibration(calibration); !ok) return say(Severity::error, ok.error().message());
  maestro_ = {calibration, channel};
  options_.maestro = wish_for(maestro_);
  keep_calibration();
  if (options_.device == "maestro") restart_session();
}

void AppModel::keep_calibration() {
  const std::filesystem::path file = maestro_file();
  if (file.empty()) return;
  const std::string serial = attached_maestro();
  if (serial.empty())
    return say(Severity::note,
               "no Maestro with a serial number is attached: the calibration holds until the window closes");
  const Status kept = keep_maestro_setup(file, serial, maestro_);
  if (kept)
    say(Severity::note, "calibration of the Maestro " + serial + " kept in " + file.string());
  else
    say(Severity::error, kept.error().message());
}

void AppModel::restart_session() {
  if (scene_ == nullptr) return;
  // The old session's devices are let go before the new one asks for them.
  session_.reset();
  status_ = {};
  store_.clear();
  bookmarks_.clear_automatic();
  parameter_marks_.clear();
  last_preset_id_.reset();
  tick_.clear();
  error_fan_.clear();
  go_live();
  make_session();
}

void AppModel::frame_scene() {
  if (scene_ == nullptr) return;
  view_.camera.frame(world_bounds(*scene_), 1.05, view_.rooms);
  view_.framed_distance_m = view_.camera.distance_m;
  ++view_.framings;
}

namespace {
std::string change_text(const PresetKey& key, double from, double to) {
  return key.full_name() + " " + display_with_unit(key, from) + " \u2192 " + display_with_unit(key, to);
}
}  // namespace

void AppModel::look_at_place(const Vec3& point_world, const Vec3& normal, std::uint32_t triangle) {
  Camera& camera = view_.camera;
  camera.look_from(normal);
  camera.orbit(0.35, camera.pitch_rad > 0.6 ? -0.3 : 0.3);
  camera.target = point_world;
  camera.distance_m = std::clamp(camera.distance_m, 0.05 * camera.scene_radius_m, 1.2 * camera.scene_radius_m);
  view_.picked_triangle = triangle;
}

void AppModel::look_at_worst() {
  if (map_.worst().empty())
    return say(Severity::note, map_.on ? "no place is worse than the others" : "choose a map first");
  const MapPlace& place = map_.worst()[worst_shown_++ % map_.worst().size()];
  look_at_place(place.point_world, place.normal, place.triangle);
}

void AppModel::set_value(const PresetKey& key, double value) {
  const double before = key.get(presets().current());
  PresetEditor tried = presets();
  if (!tried.set(key, value)) return;
  const std::string what = change_text(key, before, key.get(tried.current()));
  if (slots_.apply(what, [&](PresetEditor& editor) { return editor.set(key, value); })) send_preset(what);
}

void AppModel::set_condition(const RenderingCondition& condition) {
  const std::string what = "rendering condition " + std::string(condition.name);
  Preset wanted = presets().current();
  tangent::set_condition(wanted, condition);
  const PresetKey &force = *find_preset_key("force", "source"), &tactile = *find_preset_key("display", "source");
  const auto set = [&](PresetEditor& editor) {
    const bool one = editor.set(force, force.get(wanted));
    return editor.set(tactile, tactile.get(wanted)) || one;
  };
  if (slots_.apply(what, set)) send_preset(what);
}

void AppModel::slide_value(const PresetKey& key, double value) {
  const std::string name = key.full_name();
  const std::string what = name + " slid to " + display_with_unit(key, std::clamp(value, key.min, key.max));
  if (slots_.apply(
          what, [&](PresetEditor& editor) { return editor.set(key, value); }, name))
    send_preset(what);
}

void AppModel::type_value(const PresetKey& key, const std::string& text) {
  const auto value = parse_typed(key, text);
  if (!value) {
    say(Severity::error, value.error().message());
    return;
  }
  if (*value < key.min || *value > key.max) {
    say(Severity::warning, key.full_name() + " goes from " + display_range(key) + "; " + text + " was cut to that");
  }
  set_value(key, *value);
}

void AppModel::revert_value(const PresetKey& key) { set_value(key, key.get(presets().loaded().preset)); }

void AppModel::revert_preset() {
  const std::string what = "revert to " + presets().name();
  const auto revert = [](PresetEditor& editor) {
    const bool changed = editor.changed();
    editor.revert_all();
    return changed;
  };
  if (slots_.apply(what, revert)) send_preset(what);
}

void AppModel::load_preset(const std::filesystem::path& path) {
  PresetEditor loaded = presets();
  if (auto read = loaded.load(path); !read) {
    say(Severity::error, read.error().message());
    return;
  }
  const std::string what = "load " + loaded.name();
  slots_.apply(what, [&](PresetEditor& editor) {
    editor = loaded;
    return true;
  });
  send_preset(what);
  say(Severity::note, "preset " + presets().name() + " loaded");
}

void AppModel::undo() {
  if (!slots_.can_undo()) return say(Severity::note, "nothing to undo");
  const std::string what = "undo " + slots_.undo_name();
  slots_.undo();
  send_preset(what);
  say(Severity::note, what);
}

void AppModel::redo() {
  if (!slots_.can_redo()) return say(Severity::note, "nothing to redo");
  slots_.redo();
  const std::string what = "redo " + slots_.undo_name();
  send_preset(what);
  say(Severity::note, what);
}

void AppModel::toggle_ab() {
  const bool another = slots_.toggle();
  const std::string what = std::string("switch to ") + slot_name(slots_.active_slot());
  if (another) send_preset(what);
}

const std::string& AppModel::preset_note(std::uint32_t preset_id) const {
  static const std::string kNothing;
  const auto found = preset_notes_.find(preset_id);
  return found == preset_notes_.end() ? kNothing : found->second;
}

bool AppModel::is_favourite(const PresetKey& key) const {
  return std::find(favourites_.begin(), favourites_.end(), key.full_name()) != favourites_.end();
}

void AppModel::toggle_favourite(const PresetKey& key) {
  if (std::erase(favourites_, key.full_name()) == 0) favourites_.push_back(key.full_name());
}

bool AppModel::save_preset(const std::string& name) {
  PresetAbout about = presets().loaded().about;
  about.date = today();
  about.measured.clear();  // they were measured with other values
  if (scene_ != nullptr) {
    about.mesh_name = scene_->mesh().name();
    about.mesh_hash = hex16(scene_->mesh().content_hash());
  }
  about.device = options_.device;
  if (auto saved = slots_.save_as(preset_folder_, name, std::move(about)); !saved) {
    say(Severity::error, saved.error().message());
    return false;
  }
  refresh_preset_files();
  say(Severity::note, "preset saved as " + presets().path().string());
  return true;
}

bool AppModel::has_preset(const std::string& name) const {
  std::error_code ignored;
  return !name.empty() && std::filesystem::exists(preset_folder_ / (name + ".toml"), ignored);
}

void AppModel::refresh_preset_files() { preset_files_ = list_presets(preset_folder_); }

void AppModel::send_preset(const std::string& what) {
  if (session_ == nullptr) return;
  auto sent = session_->set_preset(presets().current());
  if (!sent) {
    say(Severity::error, sent.error().message());
    return;
  }
  ++presets_sent_;
  preset_notes_[*sent] = what;
  if (preset_notes_.size() > kMostPresetNotes) preset_notes_.erase(preset_notes_.begin());
  ask_for_ghost();
}

void AppModel::set_hand_follows_mouse(bool on) {
  view_.hand_follows_mouse = on;
  if (session_ == nullptr || on) return;
  HandSettings hand = session_->hand();
  hand.mode = HandMode::explore;
  session_->set_hand(hand);
}

void AppModel::lead_hand(const Vec3& finger_centre_world_m) {
  if (session_ != nullptr) session_->set_hand_target(finger_centre_world_m);
}

bool AppModel::stopped() const {
  return status_.servo.gate_state == GateState::disarmed || status_.servo.gate_state == GateState::faulted;
}

void AppModel::toggle_stop() {
  if (session_ == nullptr) return;
  if (stopped())
    session_->arm();
  else
    session_->stop();
}

void AppModel::set_ui_scale(float scale) { ui_scale_ = std::clamp(scale, 0.6f, 3.0f); }

}  // namespace tangent
