#include "workbench/recording/session_recorder.h"

#include "core/base/text.h"
#include "devices/contact_display.h"
#include "devices/force_device.h"

namespace tangent {
namespace {

const char* kind_of(SafetyEntry::Kind kind) {
  switch (kind) {
    case SafetyEntry::Kind::state:
      return "state";
    case SafetyEntry::Kind::fault:
      return "fault";
    case SafetyEntry::Kind::action:
      return "action";
  }
  return "";
}

}  // namespace

std::vector<RecordedValue> session_values(const Session& session) {
  std::vector<RecordedValue> values;
  const auto add = [&values](const std::vector<RecordedValue>& more) {
    values.insert(values.end(), more.begin(), more.end());
  };
  if (const ForceCapabilities* can = session.force_capabilities()) add(recorded_values(*can));
  if (const DisplayCapabilities* can = session.display_capabilities()) add(recorded_values(*can));
  const SessionStatus status = session.status();
  const Placement& place = status.placement;
  const std::pair<const char*, double> numbers[]{
      {"servo_hz", status.servo.nominal_hz},  {"place_scale", place.scale},
      {"place_qw", place.rotation.w},         {"place_qx", place.rotation.x},
      {"place_qy", place.rotation.y},         {"place_qz", place.rotation.z},
      {"place_offset_x_m", place.offset_m.x}, {"place_offset_y_m", place.offset_m.y},
      {"place_offset_z_m", place.offset_m.z}};
  for (const auto& [name, value] : numbers) values.push_back({"run", name, value});
  return values;
}

std::vector<RecordedEvent> safety_events(const SafetyLog& log, std::uint64_t from_tick) {
  std::vector<RecordedEvent> events;
  for (const SafetyEntry& entry : log.entries())
    if (entry.tick >= from_tick) events.push_back({entry.tick, entry.t_s, kind_of(entry.kind), entry.text});
  return events;
}

SessionRecorder::SessionRecorder(Session& session, RecordingFile file, bool threaded)
    : session_(session),
      recorder_(std::move(file), [&session](ServoRecord& record) { return session.pop_recorded(record); }),
      threaded_(threaded),
      placement_(session.status().placement) {}

Result<std::unique_ptr<SessionRecorder>> SessionRecorder::start(Session& session, const std::filesystem::path& path,
                                                                SessionRecording options) {
  Result<RecordingFile> file = RecordingFile::create(path, session_values(session));
  if (!file) return tl::unexpected(file.error());
  auto made = std::unique_ptr<SessionRecorder>(new SessionRecorder(session, std::move(*file), options.threaded));
  made->recorder_.add_scene(session.status().scene_sent, session.scene(), std::move(options.scene_name),
                            std::move(options.source));
  ServoRecord old;
  while (session.pop_recorded(old)) {}  // of a recording before this one
  session.attach_recorder();
  made->poll();
  if (options.threaded) made->recorder_.start();
  return made;
}

void SessionRecorder::poll() {
  for (; presets_known_ <= session_.preset_id(); ++presets_known_) {
    recorder_.add_preset(presets_known_, *session_.preset(presets_known_));
    if (presets_known_ == 0 || session_.history().empty()) continue;
    const TickRecord& newest = session_.history().newest().tick;
    recorder_.add_event({newest.tick, newest.input.t_s, "preset", "preset " + std::to_string(presets_known_)});
  }
  note_placement();
  for (RecordedEvent& event : safety_events(session_.safety_log(), log_tick_)) {
    log_tick_ = event.tick + 1;
    recorder_.add_event(std::move(event));
  }
  if (!threaded_) recorder_.pump();
}

void SessionRecorder::note_placement() {
  const Placement now = session_.status().placement;
  if (now == placement_ || session_.history().empty()) return;
  placement_ = now;
  std::string text = "placement:";
  for (const double value : {now.scale, now.rotation.w, now.rotation.x, now.rotation.y, now.rotation.z, now.offset_m.x,
                             now.offset_m.y, now.offset_m.z}) {
    text += ' ';
    append_double(text, value);
  }
  const TickRecord& newest = session_.history().newest().tick;
  recorder_.add_event({newest.tick, newest.input.t_s, "placement", text});
}

void SessionRecorder::scene_changed(std::uint32_t id, std::shared_ptr<const ContactScene> scene, std::string name,
                                    SceneSource source) {
  recorder_.add_scene(id, std::move(scene), std::move(name), std::move(source));
}

Status SessionRecorder::finish() {
  session_.detach_recorder();
  poll();
  return recorder_.stop();
}

}  // namespace tangent
