// Keys. ImGui 1.86 knows letters and signs by the platform's own codes; GLFW's are their ASCII codes, capital.
#include "workbench/gui/panels/panels.h"

namespace tangent {

void handle_shortcuts(AppModel& model, MenuBar& menu) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  const auto named = [](ImGuiKey key, bool repeat = false) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat); };
  const auto letter = [](char c, bool repeat = false) { return ImGui::IsKeyPressed(c, repeat); };
  if (io.KeyCtrl) {
    if (letter('O')) menu.path.open = menu.path.focus = true;
    if (letter('Q')) model.ask_to_close();
    if (letter('=')) model.set_ui_scale(model.ui_scale() * 1.1f);
    if (letter('-')) model.set_ui_scale(model.ui_scale() / 1.1f);
    if (letter('0')) model.set_ui_scale(1.0f);
    return;
  }
  const int by = io.KeyShift ? 10 : 1;
  if (named(ImGuiKey_Space)) model.set_paused(!model.paused());
  if (named(ImGuiKey_LeftArrow, true)) model.step_tick(-by);
  if (named(ImGuiKey_RightArrow, true)) model.step_tick(by);
  if (letter(',', true)) model.step_iteration(-1);
  if (letter('.', true)) model.step_iteration(1);
  if (named(ImGuiKey_Home)) model.select_tick(model.first_tick());
  if (named(ImGuiKey_End)) model.go_live();
  if (letter('F')) model.frame_scene();
  if (letter('M')) model.set_hand_follows_mouse(!model.view().hand_follows_mouse);
  if (named(ImGuiKey_Escape) && !menu.path.open && !model.stopped()) model.toggle_stop();
}

}  // namespace tangent
