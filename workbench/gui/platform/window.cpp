#include "workbench/gui/platform/window.h"

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/model/file_origin_of.h"
#include "workbench/gui/platform/frame_times.h"
#include "workbench/gui/platform/glfw_window.h"
#include "workbench/gui/platform/save_picture.h"
#include "workbench/gui/platform/ui_drawing.h"
#include "workbench/gui/platform/window_input.h"
#include "workbench/gui/render/image.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/session/crash_stop.h"

#include <epoxy/gl.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tangent {
namespace {

constexpr double kFrameInterval = 1.0 / 60.0;  // s, where the driver does not wait for vertical sync
constexpr double kIdleInterval = 0.25;         // s between frames when nothing moves
constexpr double kShaderCheckInterval = 0.5;   // s
constexpr int kSettlingFrames = 4;             // frames that ImGui needs to settle after an event

/// Xlib calls exit() when its server is gone: what is to outlive the window is written then, too. This runs before
/// what crash_stop.h does at exit, as the last one registered runs first: so it ends the force itself before it writes.
class KeptAtExit {
 public:
  explicit KeptAtExit(App& app) {
    app_ = &app;
    [[maybe_unused]] static const int once = std::atexit([] {
      end_servos();
      if (app_ != nullptr) app_->model().keep();
    });
  }
  ~KeptAtExit() { app_ = nullptr; }
  KeptAtExit(const KeptAtExit&) = delete;
  KeptAtExit& operator=(const KeptAtExit&) = delete;

 private:
  static inline App* app_ = nullptr;
};

WindowHandle open_window() {
  hint_opengl();
  int x = 0, y = 0, width = 1280, height = 720;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &width, &height);
  const auto share = [](int whole, int least) { return std::max(std::min(whole, least), whole * 85 / 100); };
  WindowHandle window(glfwCreateWindow(share(width, 1280), share(height, 720), "Tangent Workbench", nullptr, nullptr));
  if (window) glfwSetWindowSizeLimits(window.get(), 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
  return window;
}

FrameInput frame_input(GLFWwindow* window, double dt_s, std::vector<std::string> dropped) {
  const WindowSize size = window_size(window);
  FrameInput input;
  input.width = size.width;
  input.height = size.height;
  input.content_scale = size.scale;
  input.dt_s = std::clamp(dt_s, 1e-4, 0.5);
  input.now_s = glfwGetTime();
  input.dropped_files = std::move(dropped);
  return input;
}

/// Whether it was another one than the last, and so drawn.
bool draw_frame(GLFWwindow* window, App& app, const FrameInput& input, InputQueue& events, UiDrawing& drawing) {
  if (app.prepare(input)) {
    upload_fonts_again();
    drawing.forget();
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  events.apply(ImGui::GetIO());
  app.frame(input);
  int width_px = 0, height_px = 0;
  glfwGetFramebufferSize(window, &width_px, &height_px);
  const auto file = app.take_screenshot_request();
  const auto request = app.model().exports().take_picture_request();
  // What is in the window already is not drawn again.
  if (!drawing.changed(*ImGui::GetDrawData(), app.picture_version()) && !file && !request) return false;
  glViewport(0, 0, width_px, height_px);
  UiDrawing::draw(*ImGui::GetDrawData(), app.ground());
  if (file) {
    const Status written = write_png(read_pixels(0, width_px, height_px), *file, {.origin = file_origin(app.model())});
    if (written)
      app.model().messages().say(
          Severity::note, "screenshot written to " + std::filesystem::absolute(*file).lexically_normal().string());
    else
      app.model().messages().say(Severity::error, written.error().message());
  }
  if (request) {
    save_picture(app.model(), *request, read_pixels(0, width_px, height_px),
                 static_cast<double>(ImGui::GetIO().DisplayFramebufferScale.x));
  }
  glfwSwapBuffers(window);
  return true;
}

class FrameLoop {
 public:
  FrameLoop(GLFWwindow* window, App& app, SceneRenderer& renderer)
      : window_(window),
        app_(app),
        renderer_(renderer),
        events_(window, {[&app](int key) {
                           if (key == GLFW_KEY_ESCAPE) app.stop();
                         },
                         [this] { drawing_.forget(); },
                         [this](const std::vector<std::string>& paths) {
                           dropped_.insert(dropped_.end(), paths.begin(), paths.end());
                         }}) {}

  void run(const std::function<bool()>& should_stop) {
    double last = glfwGetTime();
    while (!glfwWindowShouldClose(window_) && !app_.wants_close() && !(should_stop && should_stop())) {
      wait_for_work(last);
      const double now = glfwGetTime();
      times_.begin();
      const bool events = events_.waiting();
      check_shaders(now);
      FrameInput input = frame_input(window_, now - last, std::exchange(dropped_, {}));
      input.last_frame_ms = last_frame_ms_;
      const bool drawn = draw_frame(window_, app_, input, events_.queue(), drawing_);
      times_.end(events, drawn);
      last_frame_ms_ = 1e3 * (glfwGetTime() - now);
      if (std::string title = app_.title(); title != title_) glfwSetWindowTitle(window_, (title_ = title).c_str());
      last = now;
    }
    if (const Status written = times_.write(); !written)
      std::fprintf(stderr, "%s\n", written.error().message().c_str());
  }

 private:
  void wait_for_work(double last_frame_s) {
    const bool hidden = glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE;
    const bool lively = !hidden && (app_.wants_frames() || renderer_.refining() || events_.waiting() || settling_ > 0);
    const double due = last_frame_s + (lively ? kFrameInterval : kIdleInterval);
    if (settling_ > 0) --settling_;
    glfwPollEvents();
    for (double wait = due - glfwGetTime(); wait > 0.0; wait = due - glfwGetTime()) {
      glfwWaitEventsTimeout(wait);
      // When idle an event is handled at once; when animating it waits for the next frame.
      if (!lively && due - glfwGetTime() > 0.1 * kIdleInterval) {
        settling_ = kSettlingFrames;
        return;
      }
    }
  }

  void check_shaders(double now) {
    if (now < next_shader_check_) return;
    next_shader_check_ = now + kShaderCheckInterval;
    renderer_.reload_changed_shaders();
    if (renderer_.shader_error() == shader_error_) return;
    shader_error_ = renderer_.shader_error();
    if (!shader_error_.empty()) app_.model().messages().say(Severity::error, shader_error_);
  }

  GLFWwindow* window_;
  App& app_;
  SceneRenderer& renderer_;
  std::vector<std::string> dropped_;
  WindowInput events_;
  std::string title_, shader_error_;
  UiDrawing drawing_;
  FrameTimes times_;
  double next_shader_check_ = 0.0;
  double last_frame_ms_ = 0.0;
  int settling_ = kSettlingFrames;
};

}  // namespace

Status display_available() {
  const GlfwLibrary library;
  if (library.ready()) return {};
  return fail("no display: " + glfw_reason(), "window", "start it in a desktop session, or set DISPLAY");
}

Status run_window(const AppOptions& options, const std::function<bool()>& should_stop) {
  const GlfwLibrary library;
  if (!library.ready()) {
    return fail("no display: " + glfw_reason(), "window", "start it in a desktop session, or set DISPLAY");
  }
  const WindowHandle window = open_window();
  if (!window) {
    return fail("no window with OpenGL 3.3: " + glfw_reason(), "window",
                "update the graphics driver, or use software GL (LIBGL_ALWAYS_SOFTWARE=1)");
  }
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(1);
  const ImGuiOnWindow imgui(window.get());
  SceneRenderer renderer;
  if (Status ready = renderer.init(); !ready) return ready;
  App app(options);
  app.set_renderer(&renderer);
  const KeptAtExit kept(app);
  FrameLoop(window.get(), app, renderer).run(should_stop);
  if (!app.script_failure().empty()) return fail(app.script_failure());
  return {};
}

}  // namespace tangent
