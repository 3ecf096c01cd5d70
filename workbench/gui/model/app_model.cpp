#include "workbench/gui/model/app_model.h"

#include "workbench/bringup/proved_devices.h"
#include "workbench/session/falcon_setups.h"

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
      bring_up_(devices_, messages_, options_.deterministic,
                options_.settings.empty() ? "" : options_.settings.parent_path() / kProvedFile),
      calibration_(devices_, messages_, options_.deterministic,
                   options_.settings.empty() ? "" : options_.settings.parent_path() / kFalconFile),
      guard_(
          options_, scene_, presets_, devices_, messages_, [this](const std::string& what) { preset_changed(what); },
          [this] {
            time_.set_in_force(nullptr);
            tune_.trial_refused();
            time_.preset_sent();
          }),
      time_(options_, devices_, presets_, messages_),
      recordings_(options_, scene_, presets_, time_, messages_,
                  [this](RecordingModel::Loaded loaded) { show_recording(std::move(loaded)); }),
      record_(options_, devices_, scene_, time_, messages_),
      tuning_(options_, presets_, time_, messages_),
      tune_(options_, presets_, time_, scene_, messages_),
      evidence_(options_, presets_, scene_, time_, messages_),
      why_(options_, time_, presets_, view_, scene_, messages_),
      recording_pair_(options_, presets_, messages_),
      unsaved_(options_, presets_, time_, record_, messages_,
               [this](const RecordedPlace& place, const UnsavedWork& work) { open_at(place, work); }),
      exports_(options_, messages_),
      curves_(options_, presets_, time_, messages_) {
  if (const auto look = window_.read_settings()) {
    view_.camera.y_up = look->y_up;
    map_.colours = look->colours;
  }
  presets_.refresh_files();
  if (!options_.preset.empty()) presets_.load(options_.preset);
  const std::filesystem::path first = options_.mesh;
  if (first.extension() == kSessionEnding || RecordingModel::is_recording(first))
    open(options_.mesh);
  else
    scene_.open_first(options_.mesh);
}

AppModel::~AppModel() {
  bring_up_.stop();
  calibration_.stop();  // no force while a file is waited for
  devices_.end_session();
  window_.keep_settings(kept_look(), kLastWait_s);
}

const ContactMesh* AppModel::mesh() const {
  const ContactScene* scene = scene_.current().get();
  return scene != nullptr && scene->planar() == nullptr ? &scene->mesh() : nullptr;
}

void AppModel::open(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".toml")
    presets_.load(file, mesh());
  else if (std::filesystem::path(file).extension() == kSessionEnding)
    open_session(file);
  else if (RecordingModel::is_recording(file)) {
    session_.reset();
    place_.reset();
    recordings_.open(file);
  } else {
    scene_.open(file);
  }
}

void AppModel::open_at(const RecordedPlace& place, const std::optional<UnsavedWork>& work) {
  std::error_code unknown;
  if (time_.recording() != nullptr && std::filesystem::equivalent(time_.recording()->path(), place.file, unknown))
    return time_.select_tick(place.tick);
  session_.reset();
  place_ = place;
  looked_at_ = work;
  recordings_.open(place.file);
}

void AppModel::show_compared(bool in_second) {
  const Result<RecordedPlace> place = recording_pair_.place(in_second);
  if (!place) return messages_.refuse(place.error().message());
  open_at(*place);
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
    return messages_.refuse("click a triangle to solve there");
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
  bring_up_.update();
  calibration_.update();
  scene_.update();
  recordings_.update();
  if (scene_.current() == nullptr && !scene_.loading() && !recordings_.opening()) scene_.open_first({});
  take_ticks();
  see_mesh_of_tick();
  view_.see_contact(tick_in_view(), time_.paused());
  window_.update(now_s, kept_look());
  unsaved_.update(now_s);
  tune_.update();
  evidence_.update();
  recording_pair_.update();
  const auto& scene = scene_.current();
  // A 2D scene has no mesh for a map.
  map_.update(scene != nullptr && scene->planar() != nullptr ? nullptr : scene, presets_.current(), now_s,
              presets_.slots().gesture_open(), options_.deterministic);
}

const TickRecord* AppModel::tick_in_view() const {
  const ServoRecord* record = time_.tick().record();
  return record != nullptr ? &record->tick : nullptr;
}

/// A mesh that was opened meanwhile stays in view until the ticks' own changes.
void AppModel::see_mesh_of_tick() {
  const OpenedRecording* recording = time_.recording();
  const auto scene = recording != nullptr ? time_.scene_of_tick() : scene_.of_servo();
  if (scene == seen_scene_) return;
  seen_scene_ = scene;
  if (scene != nullptr) scene_.look_at(scene, recording != nullptr ? recording->source_of(*scene) : nullptr);
}

void AppModel::advance(std::uint64_t ticks) {
  bring_up_.advance(ticks);
  calibration_.advance(ticks);
  if (devices_.session() == nullptr || !options_.deterministic) return;
  devices_.session()->advance(ticks);
  take_ticks();
}

void AppModel::take_ticks() {
  exports_.take_finished();
  time_.take_records();
  record_.update();
  if (devices_.session() == nullptr && time_.recording() == nullptr) return;
  devices_.take_status();
  guard_.update();
  time_.set_in_force(guard_.in_force());
  time_.show_tick();
  tuning_.update();
}

void AppModel::scene_loaded(SceneChange change) {
  if (change.opened) {
    if (!scene_.path().empty()) window_.opened(scene_.path());
    view_.look_at_new_scene();
  }
  if (change.prepared == nullptr) return;
  devices_.take_scene(std::move(change.prepared));
  record_.scene_changed();
  time_.offer_scene(scene_.current());
}

void AppModel::show_recording(RecordingModel::Loaded loaded) {
  const OpenedRecording& recording = *loaded.recording;
  window_.opened(std::filesystem::absolute(recording.path()).lexically_normal().string());
  if (loaded.scene)
    scene_.show(std::move(*loaded.scene),
                recording.source() != nullptr ? recording.source()->options : ContactMeshOptions{});
  else if (scene_.current() == nullptr && !scene_.loading())
    scene_.open_first({});
  if (const Preset* first = recording.preset(recording.page().records.oldest().tick.preset_id))
    presets_.take_recorded(*first, recording.path().stem().string());
  const bool of_session = session_ && session_->recording == recording.path();
  time_.show(std::move(loaded.recording));
  show_place(recording);
  if (of_session) show_session(*std::exchange(session_, std::nullopt));
}

/// The place that the recording was opened for.
void AppModel::show_place(const OpenedRecording& recording) {
  const auto place = std::exchange(place_, std::nullopt);
  const auto work = std::exchange(looked_at_, std::nullopt);
  if (!place || place->file != recording.path()) return;
  if (work && !work->opened.file.empty()) time_.take_bookmarks(work->opened.bookmarks);
  if (work && work->steps.size() > 1) presets_.take_up(*work);
  time_.select_tick(place->tick);
}

void AppModel::open_session(const std::filesystem::path& file) {
  Result<SavedSession> read = read_session(file);
  if (!read) return messages_.say(Severity::error, read.error().message());
  window_.opened(std::filesystem::absolute(file).lexically_normal().string());
  session_ = std::move(*read);
  recordings_.open(std::filesystem::path(session_->recording));  // a copy: it may be shown at once
}

void AppModel::show_session(const SavedSession& session) {
  const OpenedRecording& recording = *time_.recording();
  if (!session.recorded_utc.empty() && session.recorded_utc != recording.info().started_utc)
    messages_.say(Severity::warning, recording.path().filename().string() +
                                         " is not the recording that the session was saved with, but one of that name");
  const KeptLook look = window_.take(session.window);
  session_view_ = session.view;
  map_.colours = look.colours;
  view_.camera.y_up = look.y_up;
  if (!session.work.steps.empty()) presets_.take_up(session.work);
  time_.take_bookmarks(session.work.bookmarks);
}

Result<SavedSession> AppModel::session_to_save(const std::filesystem::path& file) {
  SavedSession session;
  if (const OpenedRecording* recording = time_.recording()) {
    session.recording = recording->path();
    session.recorded_utc = recording->info().started_utc;
  } else {
    if (devices_.session() == nullptr || devices_.session()->history().empty())
      return fail("there is no tick to record", file.string(), "let the servo run first");
    session.recording = std::filesystem::path(file).replace_extension(".sqlite");
    std::error_code ignored;
    if (std::filesystem::exists(session.recording, ignored))
      return fail("is there already, and a recording is never written over", session.recording.string(),
                  "choose another name for the session");
    record_.write_history(session.recording);
  }
  session.window = window_.settings_now(kept_look());
  presets_.slots().put_into(session.work);
  if (!session.work.steps.empty()) {
    session.work.steps = {session.work.steps[session.work.at]};
    session.work.at = 0;
  }
  for (const Bookmark& mark : time_.bookmarks().all())
    if (mark.kind == BookmarkKind::user) session.work.bookmarks.push_back({mark.tick, mark.t_s, mark.note});
  return session;
}

void AppModel::preset_changed(const std::string& what) {
  const bool sent = guard_.lets_through(what);
  time_.set_in_force(guard_.in_force());
  if (sent) return send_preset(what);
  time_.preset_sent();  // the recorded past may be solved with it meanwhile
}

void AppModel::send_preset(const std::string& what) {
  const auto id = devices_.send_preset();
  if (id) presets_.note_sent(*id, what);
  if (!id && devices_.session() == nullptr) return;
  if (!id) guard_.refused_by_session();
  time_.set_in_force(guard_.in_force());
  time_.preset_sent();
}

}  // namespace tangent
