#include "workbench/gui/app_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace tangent {

namespace {

constexpr double kHistory_s = 120.0;
constexpr const char* kBuiltInScene = "torus";

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
    : options_(options), store_(kChannelCount, static_cast<std::size_t>(kHistory_s * 1000.0)), theme_(options.theme) {
  preset_folder_ = options_.preset_folder;
  // A preset brings its neighbours with it.
  if (preset_folder_.empty() && options_.preset.has_parent_path()) preset_folder_ = options_.preset.parent_path();
  if (preset_folder_.empty()) preset_folder_ = options_.preset.empty() ? std::filesystem::path(TANGENT_PRESET_DIR) : ".";
  refresh_preset_files();
  if (!options_.preset.empty()) load_preset(options_.preset);
  if (!options_.record.empty()) say(Severity::warning, "recording to a file is not there yet; " + options_.record.string() + " is not written");
  open_mesh(options_.mesh.empty() ? kBuiltInScene : options_.mesh);
  if (scene_ == nullptr && !loader_.busy()) open_mesh(kBuiltInScene);
}

AppModel::~AppModel() = default;

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
  if (auto audit = loader_.poll_audit()) audit_ = std::move(*audit);
  take_records();
  show_tick();
}

void AppModel::advance(std::uint64_t ticks) {
  if (session_ == nullptr || !options_.deterministic) return;
  session_->advance(ticks);
  take_records();
  show_tick();
}

void AppModel::open_mesh(const std::string& mesh) {
  opening_path_ = mesh;
  SceneRequest request{mesh, options_.metres_per_unit, options_.mesh_options, presets_.current().finger};
  if (!options_.deterministic) {
    loader_.request(std::move(request));
    return;
  }
  auto loaded = load_scene(request);
  if (!loaded) say(Severity::error, loaded.error().message()); else take_scene(std::move(*loaded));
}

void AppModel::take_scene(LoadedScene loaded) {
  scene_ = std::move(loaded.scene);
  polygons_ = std::move(loaded.polygons);
  load_seconds_ = loaded.seconds;
  mesh_path_ = opening_path_;
  audit_.reset();
  view_.picked_triangle = view_.hovered_triangle = kNone;
  frame_scene();
  for (const std::string& note : scene_->mesh().notes()) say(Severity::note, note);
  if (session_ != nullptr) session_->set_scene(std::move(loaded.prepared));
  else make_session();
  if (options_.deterministic) audit_ = audit_mesh(*polygons_, scene_->mesh());
  else loader_.request_audit(polygons_, scene_);
}

void AppModel::make_session() {
  SessionOptions options;
  options.servo.rate_hz = options_.servo_hz;
  options.devices = options_.device;
  options.seed = options_.seed;
  options.history_s = kHistory_s;
  options.threaded = !options_.deterministic;
  auto session = Session::create(scene_, presets_.current(), options);
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
  if (scene_ == nullptr) return;
  // The old session's devices are let go before the new one asks for them.
  session_.reset();
  status_ = {};
  store_.clear();
  tick_.clear();
  go_live();
  make_session();
}

void AppModel::frame_scene() {
  if (scene_ != nullptr) view_.camera.frame(world_bounds(*scene_));
}

void AppModel::set_value(const PresetKey& key, double value) {
  if (presets_.set(key, value)) send_preset();
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

void AppModel::revert_value(const PresetKey& key) {
  if (presets_.revert(key)) send_preset();
}

void AppModel::revert_preset() {
  if (!presets_.changed()) return;
  presets_.revert_all();
  send_preset();
}

void AppModel::load_preset(const std::filesystem::path& path) {
  if (auto loaded = presets_.load(path); !loaded) {
    say(Severity::error, loaded.error().message());
    return;
  }
  send_preset();
  say(Severity::note, "preset " + presets_.name() + " loaded");
}

void AppModel::save_preset(const std::string& name) {
  PresetAbout about = presets_.loaded().about;
  about.date = today();
  about.measured.clear();  // they were measured with other values
  if (scene_ != nullptr) {
    about.mesh_name = scene_->mesh().name();
    about.mesh_hash = hex16(scene_->mesh().content_hash());
  }
  about.device = options_.device;
  if (auto saved = presets_.save_as(preset_folder_, name, std::move(about)); !saved) {
    say(Severity::error, saved.error().message());
    return;
  }
  refresh_preset_files();
  say(Severity::note, "preset saved as " + presets_.path().string());
}

void AppModel::refresh_preset_files() { preset_files_ = list_presets(preset_folder_); }

void AppModel::send_preset() {
  if (session_ == nullptr) return;
  if (auto sent = session_->set_preset(presets_.current()); !sent) {
    say(Severity::error, sent.error().message());
    return;
  }
  ++presets_sent_;
}

double AppModel::tick_period_s() const {
  return session_ != nullptr ? 1.0 / session_->options().servo.rate_hz : 1e-3;
}

void AppModel::take_records() {
  if (session_ == nullptr) return;
  session_->poll();
  const History& history = session_->history();
  if (!history.empty()) {
    // A history whose newest tick lies before ours is another run.
    const std::uint64_t next = history.newest().tick.tick < store_.end_tick() && history.newest().tick.tick + 1 != store_.end_tick()
                                   ? history.oldest().tick.tick : store_.end_tick();
    std::array<float, kChannelCount> row{};
    for (std::size_t i = history.lower_bound(next); i < history.size(); ++i) {
      const ServoRecord& r = history[i];
      const Vec3& f = r.device.force_command_n;
      // In simulated time nothing is measured: a gap rather than a zero.
      const float tick_time = r.tick_ns > 0.0 ? static_cast<float>(r.tick_ns * 1e-9) : std::nanf("");
      row = {static_cast<float>(f.x), static_cast<float>(f.y), static_cast<float>(f.z),
             static_cast<float>(glm::length(f)), static_cast<float>(r.device.cld_command_m),
             static_cast<float>(r.device.cld_measured_m), static_cast<float>(r.tick.output.error_m),
             static_cast<float>(r.tick.output.iterations), tick_time};
      store_.push(r.tick.tick, row);
    }
  }
  status_ = session_->status();
  if (status_.servo.gate_fault != last_gate_fault_ && status_.servo.gate_fault != GateFault::none) {
    say(Severity::error, std::string("force stopped: ") + to_string(status_.servo.gate_fault) + "; press Arm to go on");
  }
  last_gate_fault_ = status_.servo.gate_fault;
  if (status_.force_fault != last_fault_ && status_.force_fault != DeviceFault::none) {
    say(Severity::error, std::string("force device: ") + to_string(status_.force_fault));
  }
  last_fault_ = status_.force_fault;
  axis_.update(store_.first_tick(), store_.end_tick(), static_cast<double>(store_.capacity()));
}

void AppModel::show_tick() {
  if (session_ == nullptr || session_->history().empty()) return;
  const History& history = session_->history();
  if (!paused_ || !cursor_) {
    tick_.show(*session_, history.newest());
    return;
  }
  if (const ServoRecord* record = history.find(*cursor_)) tick_.show(*session_, *record);
}

void AppModel::set_paused(bool paused) {
  if (paused == paused_) return;
  if (!paused) {
    go_live();
    return;
  }
  paused_ = true;
  axis_.hold();
  if (const ServoRecord* record = tick_.record()) cursor_ = record->tick.tick;
}

void AppModel::go_live() {
  paused_ = false;
  cursor_.reset();
  axis_.follow();
  axis_.update(store_.first_tick(), store_.end_tick(), static_cast<double>(store_.capacity()));
  show_tick();
}

void AppModel::select_tick(std::uint64_t tick) {
  if (session_ == nullptr || session_->history().empty()) return;
  set_paused(true);
  const History& history = session_->history();
  const std::size_t at = std::min(history.lower_bound(tick), history.size() - 1);
  cursor_ = history[at].tick.tick;
  axis_.reveal(static_cast<double>(*cursor_));
  show_tick();
}

void AppModel::step_tick(std::int64_t by) {
  if (session_ == nullptr || session_->history().empty()) return;
  set_paused(true);
  const History& history = session_->history();
  const std::size_t now = std::min(history.lower_bound(cursor_.value_or(history.newest().tick.tick)), history.size() - 1);
  const auto last = static_cast<std::int64_t>(history.size()) - 1;
  const std::int64_t to = std::clamp(static_cast<std::int64_t>(now) + by, std::int64_t{0}, last);
  select_tick(history[static_cast<std::size_t>(to)].tick.tick);
}

void AppModel::step_iteration(int by) {
  set_paused(true);
  const std::size_t count = tick_.iterations().size();
  if (count == 0) return;
  const auto last = static_cast<std::int64_t>(count) - 1;
  const std::int64_t now = tick_.selected() ? static_cast<std::int64_t>(*tick_.selected()) : (by > 0 ? -1 : last + 1);
  const std::int64_t to = now + by;
  if (to >= 0 && to <= last) {
    tick_.select(static_cast<std::size_t>(to));
    return;
  }
  const std::uint64_t before = cursor_.value_or(0);
  step_tick(by);
  if (cursor_.value_or(0) == before) return;  // there is no further tick
  if (!tick_.iterations().empty()) tick_.select(by > 0 ? 0 : tick_.iterations().size() - 1);
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
  if (stopped()) session_->arm(); else session_->stop();
}

void AppModel::set_ui_scale(float scale) { ui_scale_ = std::clamp(scale, 0.6f, 3.0f); }

}  // namespace tangent
