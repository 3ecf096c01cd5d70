// Keys. ImGui 1.86 knows letters and signs by the platform's own codes; GLFW's are their ASCII codes, capital.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

namespace tangent {

namespace {

constexpr int kF1 = 290, kF12 = 301;  // GLFW's codes

bool letter(char c, bool repeat = false) { return ImGui::IsKeyPressed(c, repeat); }

/// Keys that no text field has a use for: they work while one is typed in, too.
void handle_window_keys(AppModel& model, MenuBar& menu) {
  const bool ctrl = ImGui::GetIO().KeyCtrl;
  if (ctrl && letter('Q')) model.ask_to_close();
  if (ctrl && letter('P')) menu.palette.open = menu.palette.focus = true;
  if (ctrl && letter('O')) menu.path.open = menu.path.focus = true;
  if (ImGui::IsKeyPressed(kF1, false)) menu.sheet = !menu.sheet;
  if (ImGui::IsKeyPressed(kF12, false)) model.ask_for_screenshot();
}

void handle_ctrl_keys(AppModel& model) {
  const bool shift = ImGui::GetIO().KeyShift;
  if (shift && letter('C')) model.copy_camera();
  if (shift && letter('V')) model.paste_camera();
  if (letter('=')) model.set_ui_scale(model.ui_scale() * 1.1f);
  if (letter('-')) model.set_ui_scale(model.ui_scale() / 1.1f);
  if (letter('0')) model.set_ui_scale(1.0f);
  if (letter('Z', true)) shift ? model.redo() : model.undo();
  if (letter('Y', true)) model.redo();
}

}  // namespace

void handle_shortcuts(AppModel& model, MenuBar& menu) {
  const ImGuiIO& io = ImGui::GetIO();
  handle_window_keys(model, menu);
  if (text_is_edited()) return;
  if (io.KeyCtrl) {
    handle_ctrl_keys(model);
    return;
  }
  const auto named = [](ImGuiKey key, bool repeat = false) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
  };
  for (const NamedView& v : kStandardViews) {
    if (letter(v.key[0])) model.look_from_standard(v.view);
  }
  if (letter('U')) model.set_y_up(!model.view().camera.y_up);
  if (letter('W')) model.look_at_worst();
  if (letter('I')) io.KeyShift ? model.show_all() : model.isolate_marked();
  const int by = io.KeyShift ? 10 : 1;
  if (named(ImGuiKey_Space)) model.set_paused(!model.paused());
  if (named(ImGuiKey_LeftArrow, true)) model.step_tick(-by);
  if (named(ImGuiKey_RightArrow, true)) model.step_tick(by);
  if (letter(',', true)) model.step_iteration(-1);
  if (letter('.', true)) model.step_iteration(1);
  if (named(ImGuiKey_Home)) model.select_tick(model.first_tick());
  if (named(ImGuiKey_End)) model.go_live();
  if (letter('B')) model.toggle_ab();
  if (letter('K')) model.add_bookmark();
  if (letter('[', true)) model.go_to_bookmark(-1);
  if (letter(']', true)) model.go_to_bookmark(1);
  if (letter('F')) model.frame_scene();
  if (letter('M')) model.set_hand_follows_mouse(!model.view().hand_follows_mouse);
  if (named(ImGuiKey_Escape) && !menu.path.open && !menu.palette.open) {
    if (menu.sheet)
      menu.sheet = false;
    else if (!model.stopped())
      model.toggle_stop();
  }
}

}  // namespace tangent
