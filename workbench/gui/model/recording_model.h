// Recordings as files: opening one in a worker thread.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/opened_recording.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/gui/model/time_model.h"

#include <functional>
#include <future>
#include <memory>
#include <optional>

namespace tangent {

class RecordingModel {
 public:
  /// A recording that was read, and its scene where that is not the one in use.
  struct Loaded {
    std::unique_ptr<OpenedRecording> recording;
    std::optional<LoadedScene> scene;
  };
  RecordingModel(const AppOptions& options, const SceneModel& scene, const PresetModel& presets, const TimeModel& time,
                 MessageLog& messages, std::function<void(Loaded)> loaded);

  /// By its name (.sqlite) or its first bytes.
  static bool is_recording(const std::filesystem::path& file);
  /// In a worker thread unless deterministic. A later one replaces one that is being read. Failures are messages.
  void open(const std::filesystem::path& file);
  bool opening() const { return job_.valid(); }
  const std::filesystem::path& opening_path() const { return path_; }
  bool busy() const;  ///< something is read, and the window changes when it is done
  void update();      ///< takes in what was read

 private:
  void take(Result<Loaded> loaded);

  const AppOptions& options_;
  const SceneModel& scene_;
  const PresetModel& presets_;
  const TimeModel& time_;
  MessageLog& messages_;
  std::function<void(Loaded)> loaded_;
  std::filesystem::path path_;
  std::optional<std::filesystem::path> next_;
  std::future<Result<Loaded>> job_;
};

}  // namespace tangent
