// Export to files: recorded ticks as CSV, a plot or the whole window as PNG. A message names the file. Existing files
// are never overwritten.
#pragma once

#include "workbench/gui/layout/layout.h"
#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/save_dialog.h"
#include "workbench/session/file_origin.h"
#include "workbench/session/history.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

namespace tangent {

/// A part of the window as a PNG file.
struct PictureRequest {
  std::filesystem::path path;
  Rect of;  ///< ImGui's coordinates
};

/// The scene alone as a PNG file, of any width.
struct ScenePicture {
  std::filesystem::path path;
  int width_px = 2400;
  bool transparent = true;
  bool overlay = false;  ///< with labels, scales and colour bar
};

class ExportModel {
 public:
  ExportModel(const AppOptions& options, MessageLog& messages);
  ~ExportModel() { cancel(); }
  ExportModel(const ExportModel&) = delete;
  ExportModel& operator=(const ExportModel&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  void set_folder(std::filesystem::path folder) { folder_ = std::move(folder); }

  /// Does the work in a thread of its own, at once if deterministic. What it says when it is done, or why it failed, is
  /// a message. `what`: the file's name. One at a time: another is refused, and a message says so.
  using Work = std::function<Result<std::string>(const std::stop_token& stop)>;
  void start(std::string what, Work work);
  bool writing() const { return writing_.valid(); }
  const std::string& what() const { return what_; }
  double seconds() const { return messages_.now_s() - started_s_; }  ///< since it began
  void cancel() { stop_.request_stop(); }
  void take_finished();  ///< reports finished files

  /// Writes ticks from ... to - 1 as CSV, and beside it what its columns are and where it comes from
  /// (session/csv_metadata.h).
  void write_ticks(const HistorySnapshot& records, std::uint64_t from, std::uint64_t to, const FileOrigin& origin = {});

  SaveDialog& dialog() { return dialog_; }

  // Screenshot of the next frame. The platform, which has the pixels, takes the request once.
  void ask_for_picture(const std::string& what, const Rect& of);
  void ask_for_picture(PictureRequest request) { picture_request_ = std::move(request); }
  bool picture_wanted() const { return picture_request_.has_value(); }
  std::optional<PictureRequest> take_picture_request() { return std::exchange(picture_request_, std::nullopt); }
  /// The panel that has the renderer takes it once.
  void ask_for_scene(ScenePicture wanted) { scene_picture_ = std::move(wanted); }
  std::optional<ScenePicture> take_scene_picture() { return std::exchange(scene_picture_, std::nullopt); }
  void ask_for_screenshot() { screenshot_wanted_ = true; }
  std::optional<std::filesystem::path> take_screenshot_request();

 private:
  MessageLog& messages_;
  const bool deterministic_;
  const std::filesystem::path screenshots_;
  std::filesystem::path folder_ = ".";
  std::string what_;
  double started_s_ = 0.0;
  std::stop_source stop_;
  std::future<Result<std::string>> writing_;  ///< what is said of the file written
  std::optional<PictureRequest> picture_request_;
  bool screenshot_wanted_ = false;
  std::optional<ScenePicture> scene_picture_;
  SaveDialog dialog_;
};

}  // namespace tangent
