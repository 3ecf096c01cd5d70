// The window's state and the user's actions, without drawing, in parts. Panels read the parts and call them. All of it
// lives in the GUI's thread.
//
// The only data flow between the parts:
//
//   scene  --(a mesh was opened or built again)-->  window, view, devices     scene_loaded()
//   presets  --(values changed)-->  guard, which may hold them     preset_changed()
//   guard  -->  devices --(id of what was sent)--> presets, time     send_preset()
//   devices  --(a change was undone)-->  guard  -->  presets     guard().update()
//   devices  --(the session ends)-->  record, time     record().stop(), time().forget()
//   recordings  --(a recording was read)-->  scene, presets, time     show_recording()
//   devices  --(records, status)-->  time, once a frame     take_ticks()
//   view, map  --(look that outlives the window)-->  window     kept_look()
#pragma once

#include "workbench/gui/map/map_view.h"
#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/bring_up_model.h"
#include "workbench/gui/model/calibration_model.h"
#include "workbench/gui/model/curves_model.h"
#include "workbench/gui/model/device_model.h"
#include "workbench/gui/model/evidence_model.h"
#include "workbench/gui/model/export_model.h"
#include "workbench/gui/model/guard_model.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/record_model.h"
#include "workbench/gui/model/recording_model.h"
#include "workbench/gui/model/recording_pair_model.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/gui/model/time_model.h"
#include "workbench/gui/model/tune_model.h"
#include "workbench/gui/model/tuning_model.h"
#include "workbench/gui/model/unsaved_model.h"
#include "workbench/gui/model/view_model.h"
#include "workbench/gui/model/why_model.h"
#include "workbench/gui/model/window_model.h"
#include "workbench/session/saved_session.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace tangent {

class AppModel {
 public:
  explicit AppModel(const AppOptions& options);
  ~AppModel();

  /// Writes what is to outlive the window: its settings and the unsaved work. From time to time it is done anyway.
  void keep();
  /// Call once per frame: takes in results of the servo and the workers.
  void update(double now_s);
  /// The mesh in view becomes that of the tick in view, where a recording has several. Once a frame, and wherever
  /// another tick was chosen before the frame is drawn.
  void see_mesh_of_tick();
  /// Deterministic mode only.
  void advance(std::uint64_t ticks);
  bool deterministic() const { return options_.deterministic; }
  double now_s() const { return messages_.now_s(); }  ///< of the last update

  MessageLog& messages() { return messages_; }
  const MessageLog& messages() const { return messages_; }
  WindowModel& window() { return window_; }
  const WindowModel& window() const { return window_; }
  PresetModel& presets() { return presets_; }
  const PresetModel& presets() const { return presets_; }
  /// A preset (.toml), a recording (.sqlite), a session (.session), a mesh, a polygon, or the name of a generated
  /// object. Failures are messages.
  void open(const std::string& file);
  /// A tick of a recording, which is opened where it is not open; `work`: with the presets and bookmarks of an earlier
  /// run.
  void open_at(const RecordedPlace& place, const std::optional<UnsavedWork>& work = std::nullopt);
  /// The tick that is chosen in the comparison of two recordings, in the first or the second of them.
  void show_compared(bool in_second);
  /// A tick at a place of the mesh in view, in the direction that needs most planes (TimeModel::solve_at), with the
  /// map's moves. At once, whatever the finger does.
  void solve_here(std::uint32_t triangle, double u, double v);
  void solve_here();  ///< at the picked triangle's middle; if none is picked, at the contact of the tick in view
  /// Of the window as it is, without its view. Where no recording is open, the history is recorded beside `file`.
  Result<SavedSession> session_to_save(const std::filesystem::path& file);
  /// The view of a session that was opened, once, when its recording is shown.
  std::optional<std::map<std::string, std::string>> take_view() { return std::exchange(session_view_, std::nullopt); }
  void solve_at_worst();            ///< goes to the map's worst place, repeated to the next, and solves there
  const ContactMesh* mesh() const;  ///< null: none yet, or a 2D scene
  SceneModel& scene() { return scene_; }
  const SceneModel& scene() const { return scene_; }
  MapView& map() { return map_; }  ///< over the mesh
  const MapView& map() const { return map_; }
  ViewModel& view() { return view_; }
  const ViewModel& view() const { return view_; }
  DeviceModel& devices() { return devices_; }
  const DeviceModel& devices() const { return devices_; }
  BringUpModel& bring_up() { return bring_up_; }
  CalibrationModel& calibration() { return calibration_; }
  GuardModel& guard() { return guard_; }
  const GuardModel& guard() const { return guard_; }
  TimeModel& time() { return time_; }
  const TimeModel& time() const { return time_; }
  const TickRecord* tick_in_view() const;  ///< null: none yet
  RecordingModel& recordings() { return recordings_; }
  const RecordingModel& recordings() const { return recordings_; }
  RecordModel& record() { return record_; }
  const RecordModel& record() const { return record_; }
  TuningModel& tuning() { return tuning_; }
  TuneModel& tune() { return tune_; }
  const TuneModel& tune() const { return tune_; }
  CurvesModel& curves() { return curves_; }
  EvidenceModel& evidence() { return evidence_; }
  WhyModel& why() { return why_; }
  RecordingPairModel& recording_pair() { return recording_pair_; }
  UnsavedModel& unsaved() { return unsaved_; }
  ExportModel& exports() { return exports_; }
  const ExportModel& exports() const { return exports_; }

 private:
  void scene_loaded(SceneChange change);
  void show_recording(RecordingModel::Loaded loaded);
  void open_session(const std::filesystem::path& file);
  void show_session(const SavedSession& session);
  void show_place(const OpenedRecording& recording);
  void preset_changed(const std::string& what);
  void send_preset(const std::string& what);
  void take_ticks();
  KeptLook kept_look() const { return {view_.camera.y_up, map_.colours}; }

  // A part only uses parts declared above it.
  const AppOptions options_;
  MessageLog messages_;
  WindowModel window_;
  PresetModel presets_;
  SceneModel scene_;
  MapView map_;
  ViewModel view_;
  DeviceModel devices_;
  BringUpModel bring_up_;
  CalibrationModel calibration_;
  GuardModel guard_;
  TimeModel time_;
  RecordingModel recordings_;
  RecordModel record_;
  TuningModel tuning_;
  TuneModel tune_;
  EvidenceModel evidence_;
  WhyModel why_;
  RecordingPairModel recording_pair_;
  UnsavedModel unsaved_;
  ExportModel exports_;
  CurvesModel curves_;
  std::optional<SavedSession> session_;             ///< opened, its recording being read
  std::shared_ptr<const ContactScene> seen_scene_;  ///< by see_mesh_of_tick
  std::optional<RecordedPlace> place_;              ///< to be shown when its recording was read,
  std::optional<UnsavedWork> looked_at_;            ///< as it was looked at before a crash
  std::optional<std::map<std::string, std::string>> session_view_;
};

}  // namespace tangent
