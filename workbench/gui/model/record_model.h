// Recordings that the window writes: from now on, all that is in the history, or a selection. What happens to the file
// is said in messages; the servo never waits for it.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/device_model.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/gui/model/time_model.h"
#include "workbench/recording/recorded_stretch.h"
#include "workbench/recording/session_recorder.h"

#include <future>
#include <map>
#include <memory>
#include <optional>

namespace tangent {

class RecordModel {
 public:
  RecordModel(const AppOptions& options, DeviceModel& devices, const SceneModel& scene, const TimeModel& time,
              MessageLog& messages);
  ~RecordModel();
  RecordModel(const RecordModel&) = delete;
  RecordModel& operator=(const RecordModel&) = delete;

  /// From the next tick on, until stop(), the session's end or the window's. Empty: a new name in folder().
  void start(std::filesystem::path file = {});
  void stop();
  bool recording() const { return recorder_ != nullptr; }
  const std::filesystem::path& file() const { return file_; }  ///< of the recording that is made, or was last
  RecorderStatus status() const { return recorder_ ? recorder_->status() : last_; }

  /// The live history, or the part of it between the cursors, in a worker thread unless deterministic. Empty: a new
  /// name.
  void write_history(std::filesystem::path file = {});
  void write_selection(std::filesystem::path file = {});
  bool writing() const { return writing_.valid(); }

  /// Where files go that are given no name: that of screenshots.
  const std::filesystem::path& folder() const { return folder_; }

  // Called by AppModel.
  void update();         ///< once per frame, after the session's poll
  void scene_changed();  ///< the session has another scene

 private:
  std::filesystem::path named(std::filesystem::path file, const char* stem) const;
  void write_stretch_to(const std::filesystem::path& file, const TickRange& range);
  void know_scene();
  void note_bookmarks();
  void say_trouble();
  void take_written();

  const AppOptions& options_;
  DeviceModel& devices_;
  const SceneModel& scene_;
  const TimeModel& time_;
  MessageLog& messages_;
  const std::filesystem::path folder_;
  bool wish_ = false;  ///< the recording of the options is still to begin
  std::filesystem::path file_;
  std::unique_ptr<SessionRecorder> recorder_;
  RecorderStatus last_;
  std::string told_;                              ///< the trouble that was said last
  std::map<std::uint32_t, StretchScene> scenes_;  ///< of the session, by id
  std::map<std::uint32_t, Bookmark> marks_;       ///< of a person, as the file has them
  std::future<Result<std::string>> writing_;
};

}  // namespace tangent
