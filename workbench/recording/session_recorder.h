// Records a session: hands its ticks, presets, scenes and events to a Recorder.
//
//   auto recorder = SessionRecorder::start(*session, "F.sqlite", {source});  // before or after session->start()
//   every frame: session->poll(); recorder->poll();
//   after session->shut_down(): recorder->finish();
#pragma once

#include "workbench/recording/recorder.h"
#include "workbench/session/session.h"

namespace tangent {

/// Of devices and run.
std::vector<RecordedValue> session_values(const Session& session);
/// Faults, changes of state and what the gate did.
std::vector<RecordedEvent> safety_events(const SafetyLog& log, std::uint64_t from_tick = 0);

struct SessionRecording {
  SceneSource source;  ///< of the scene in use; without mesh and polygon: name and hash alone are recorded
  std::string scene_name;
  bool threaded = true;  ///< false: poll writes
};

class SessionRecorder {
 public:
  /// From the servo's next tick on. Fails when the file can't be made. `session` must outlive it.
  static Result<std::unique_ptr<SessionRecorder>> start(Session& session, const std::filesystem::path& path,
                                                        SessionRecording options);

  /// Owner's thread of the session, after its poll: new presets and events.
  void poll();
  /// Owner's thread, after Session::set_scene, which gave `id`.
  void scene_changed(std::uint32_t id, std::shared_ptr<const ContactScene> scene, std::string name, SceneSource source);
  /// A bookmark, for example.
  void add_event(RecordedEvent event) { recorder_.add_event(std::move(event)); }
  /// Takes nothing more, writes what is left and closes the file.
  Status finish();
  RecorderStatus status() const { return recorder_.status(); }

 private:
  void note_placement();
  SessionRecorder(Session& session, RecordingFile file, bool threaded);
  Session& session_;
  Recorder recorder_;
  bool threaded_;
  std::uint32_t presets_known_ = 0;  ///< ids below
  Placement placement_;              ///< that the file knows
  std::uint64_t log_tick_ = 0;       ///< events of the safety log before this tick are known
};

}  // namespace tangent
