// The whole window as one object: builds the ImGui frame from plain input, independent of any window system.
//
// A platform (GLFW window, or off screen) drives it like this, once a frame, on the thread that owns the
// ImGui context and the GL context:
//
//   if (app.prepare(input)) re-upload the font texture;   // before the back ends' NewFrame
//   back ends' NewFrame();                                 // size, mouse and keys into ImGuiIO
//   write injected input, if any;                          // ImGui 1.86 has no event queue
//   app.frame(input);                                      // ImGui::NewFrame ... ImGui::Render
//   draw ImGui::GetDrawData();
//
// An ImGui context must exist from before the constructor until after the destructor. Without a renderer
// (tests) the 3D view stays an empty rectangle; everything else is the same.
#pragma once

#include "workbench/gui/model/app_options.h"

#include <imgui.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

class AppModel;
class ItemMap;
enum class PlotsMode : std::uint8_t;
class SceneRenderer;

/// Input of a frame from the platform. Mouse and keys come through ImGuiIO.
struct FrameInput {
  float width = 1280.0f, height = 720.0f;  ///< ImGui's coordinates
  float content_scale = 1.0f;              ///< of the monitor: 2 on a HiDPI screen whose coordinates are pixels
  double dt_s = 1.0 / 60.0;                ///< since the last frame
  double now_s = 0.0;                      ///< any monotonic clock
  double last_frame_ms = 0.0;              ///< wall time of the last frame, drawing and showing it included; 0: unknown
  std::vector<std::string> dropped_files;  ///< since the last frame
};

class App {
 public:
  /// Never fails: errors (a mesh that can't be read, a preset with an unknown key) are shown in the window, and the
  /// built-in scene or the default preset is used instead.
  explicit App(AppOptions options = {});
  ~App();
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  /// The renderer of the 3D view; null: none. Must outlive the app's last frame.
  void set_renderer(SceneRenderer* renderer);

  /// Sets fonts and style for this scale and theme. True when the font atlas was rebuilt. Also sets DisplaySize and
  /// DeltaTime; a back end may set them again.
  bool prepare(const FrameInput& input);
  /// ImGui::NewFrame, the whole window, ImGui::Render.
  void frame(const FrameInput& input);

  /// No force, at once; what Escape does, which a platform may call before it shows the key in a frame.
  void stop();

  void show_plots(PlotsMode mode, bool values);  ///< as by their buttons

  /// Deterministic mode: runs `ticks` servo ticks now. Otherwise does nothing.
  void advance(std::uint64_t ticks);

  /// What the platform clears the window to: columns and plots draw no ground of their own.
  ImVec4 ground() const;
  /// Of the 3D view's texture in the draw data: while it stays the same the texture does.
  std::uint64_t picture_version() const;

  bool wants_close() const;   ///< file > quit was chosen
  bool wants_frames() const;  ///< something is animated: draw again without waiting for input
  /// As the script of the options, from the next frame on.
  void run_script(const std::filesystem::path& file);
  bool script_running() const;
  /// Why the script of the options ended before its end; empty: it did not. The window then wants to close.
  const std::string& script_failure() const { return script_failure_; }
  std::string title() const;  ///< for the window: mesh, preset, time in view while paused
  /// The file to which the platform should write this frame as a PNG; given once per request.
  std::optional<std::filesystem::path> take_screenshot_request();

  AppModel& model() { return *model_; }
  const AppModel& model() const { return *model_; }
  /// Rectangles of the last frame's widgets, by label path ("transport/pause").
  const ItemMap& items() const;
  double last_build_ms() const { return last_build_ms_; }  ///< CPU time of the last frame(), without the renderer

 private:
  struct Ui;
  void stop_on_escape();
  void step_script();
  std::unique_ptr<AppModel> model_;
  std::unique_ptr<Ui> ui_;
  double last_build_ms_ = 0.0;
  std::string script_failure_;
};

}  // namespace tangent
