// An App without window, GL or renderer, with simulated mouse and keys. Press, move and release take a frame each and
// are written before NewFrame: ImGui 1.86 has no event queue.
#pragma once

#include "tests/support/temp_folder.h"
#include "workbench/gui/app.h"
#include "workbench/gui/model/app_model.h"
#include "workbench/gui/widgets/item_map.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <memory>
#include <string>
#include <string_view>

namespace tangent::test {

class HeadlessApp {
 public:
  explicit HeadlessApp(AppOptions options = deterministic_options(), float width = 1280.0f, float height = 720.0f,
                       float scale = 1.0f) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    // GLFW's codes.
    io.KeyMap[ImGuiKey_Tab] = 258;
    io.KeyMap[ImGuiKey_LeftArrow] = 263;
    io.KeyMap[ImGuiKey_RightArrow] = 262;
    io.KeyMap[ImGuiKey_Home] = 268;
    io.KeyMap[ImGuiKey_End] = 269;
    io.KeyMap[ImGuiKey_Backspace] = 259;
    io.KeyMap[ImGuiKey_Space] = 32;
    io.KeyMap[ImGuiKey_Enter] = 257;
    io.KeyMap[ImGuiKey_Escape] = 256;
    io.KeyMap[ImGuiKey_A] = 'A';
    input_.width = width;
    input_.height = height;
    input_.content_scale = scale;
    if (options.screenshots.empty()) options.screenshots = folder_.path();
    app_ = std::make_unique<App>(std::move(options));
    app_->model().window().set_task(Task::all);  // every section is there to be clicked
    frames(2);
  }
  ~HeadlessApp() {
    app_.reset();
    ImGui::DestroyContext();
  }

  static AppOptions deterministic_options() {
    AppOptions options;
    options.deterministic = true;
    options.mesh = "icosphere";
    return options;
  }

  App& app() { return *app_; }
  AppModel& model() { return app_->model(); }
  FrameInput& input() { return input_; }
  const std::filesystem::path& folder() const { return folder_.path(); }

  void frame() {
    input_.now_s += input_.dt_s;
    app_->prepare(input_);
    app_->frame(input_);
    input_.dropped_files.clear();
  }
  void frames(int n) {
    for (int i = 0; i < n; ++i) frame();
  }

  ImVec2 centre(std::string_view path) {
    const ItemRect* item = app_->items().find(path);
    INFO("item ", std::string(path));
    REQUIRE(item != nullptr);
    REQUIRE(item->visible);
    return item->centre();
  }
  void move(ImVec2 to) {
    ImGui::GetIO().MousePos = to;
    frame();
  }
  void press(int button = 0) {
    ImGui::GetIO().MouseDown[button] = true;
    frame();
  }
  void release(int button = 0) {
    ImGui::GetIO().MouseDown[button] = false;
    frame();
  }
  void click(std::string_view path, int button = 0) {
    move(centre(path));
    press(button);
    release(button);
    frame();
  }
  void drag(std::string_view path, ImVec2 by, int button = 0) {
    const ImVec2 from = centre(path);
    move(from);
    press(button);
    move({from.x + 0.5f * by.x, from.y + 0.5f * by.y});
    move({from.x + by.x, from.y + by.y});
    release(button);
    frame();
  }
  void wheel(ImVec2 at, float by) {
    move(at);
    ImGui::GetIO().MouseWheel = by;
    frame();
  }
  void key(int code) {
    ImGui::GetIO().KeysDown[code] = true;
    frame();
    ImGui::GetIO().KeysDown[code] = false;
    frame();
  }
  /// With Ctrl held.
  void chord(int code) {
    ImGui::GetIO().KeyCtrl = true;
    key(code);
    ImGui::GetIO().KeyCtrl = false;
  }
  void type(const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    frame();
  }

  static constexpr int kEnter = 257, kEscape = 256, kTab = 258, kLeft = 263, kRight = 262, kSpace = 32, kHome = 268,
                       kEnd = 269;

 private:
  testing::TempFolder folder_;  ///< for what is given no other: recordings and pictures
  FrameInput input_;
  std::unique_ptr<App> app_;
};

}  // namespace tangent::test
