// An ImGui context for one screen of an experiment, without window or GL, with simulated mouse and keys.
#pragma once

#include "tests/workbench/gui/drawn_text.h"
#include "workbench/gui/experiment/operator_screen.h"
#include "workbench/gui/experiment/participant_screen.h"

#include <doctest/doctest.h>
#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

namespace tangent::test {

/// No two of the texts lie on each other.
inline void check_apart(const std::vector<DrawnText>& texts) {
  for (std::size_t i = 0; i < texts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      CHECK_FALSE_MESSAGE(collide(texts[i], texts[j]), texts[i].text << " | " << texts[j].text);
}

class HeadlessScreen {
 public:
  explicit HeadlessScreen(float width = 1280.0f, float height = 720.0f) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.KeyMap[ImGuiKey_Enter] = 257;  // GLFW's codes
    io.KeyMap[ImGuiKey_Escape] = 256;
    io.DisplaySize = {width, height};
    io.DeltaTime = 1.0f / 60.0f;
  }
  ~HeadlessScreen() { ImGui::DestroyContext(); }
  HeadlessScreen(const HeadlessScreen&) = delete;
  HeadlessScreen& operator=(const HeadlessScreen&) = delete;

  ImVec2 size() const { return ImGui::GetIO().DisplaySize; }

  void draw(const ParticipantScreen& screen, bool dark = true, const PracticePicture& scene = {}) {
    if (large_.prompt == nullptr) {
      std::vector<std::string> missing;
      large_ = load_large_fonts(size().x, size().y, missing);
    }
    ImGui::NewFrame();
    draw_participant_screen(screen, large_, size(), dark, scene);
    ImGui::Render();
  }
  const LargeFonts& large() const { return large_; }

  OperatorWishes draw(OperatorPanel& panel, const OperatorScreen& screen, Theme theme = Theme::dark) {
    panel.prepare(theme, 1.0f);
    now_s_ += 1.0 / 60.0;
    return panel.frame(screen, size(), now_s_);
  }
  /// Two frames to lay out, then the mouse there and pressed: what the frame of the press asks for, and that after it.
  OperatorWishes click(OperatorPanel& panel, const OperatorScreen& screen, std::string_view path) {
    for (int i = 0; i < 3; ++i) draw(panel, screen);
    const ItemRect* item = panel.items().find(path);
    INFO("item ", std::string(path));
    REQUIRE(item != nullptr);
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = item->centre();
    draw(panel, screen);
    io.MouseDown[0] = true;
    OperatorWishes wishes = draw(panel, screen);
    io.MouseDown[0] = false;
    const OperatorWishes after = draw(panel, screen);
    wishes.stop |= after.stop;
    wishes.resume |= after.resume;
    wishes.end |= after.end;
    wishes.give_keys |= after.give_keys;
    return wishes;
  }

 private:
  LargeFonts large_;
  double now_s_ = 0.0;
};

}  // namespace tangent::test
