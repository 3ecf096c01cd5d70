// Keyboard shortcuts. ImGui 1.86 uses the platform's key codes; GLFW's for letters are upper-case ASCII.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

namespace tangent {

namespace {

constexpr int kF1 = 290, kF12 = 301;  // GLFW's codes

bool letter(char c, bool repeat = false) { return ImGui::IsKeyPressed(c, repeat); }

/// Keys that no text field uses; they also work while typing.
void handle_window_keys(AppModel& model, MenuBar& menu) {
  const bool ctrl = ImGui::GetIO().KeyCtrl;
  if (ctrl && letter('Q')) model.window().ask_to_close();
  if (ctrl && letter('P')) menu.palette.open = menu.palette.focus = true;
  if (ctrl && letter('O')) menu.path.open = menu.path.focus = true;
  if (ImGui::IsKeyPressed(kF1, false)) menu.sheet = !menu.sheet;
  if (ImGui::IsKeyPressed(kF12, false)) model.exports().ask_for_screenshot();
}

void handle_ctrl_keys(AppModel& model) {
  const bool shift = ImGui::GetIO().KeyShift;
  if (shift && letter('C')) model.view().copy_camera();
  if (shift && letter('V')) model.view().paste_camera();
  if (letter('=')) model.window().set_ui_scale(model.window().ui_scale() * 1.1f);
  if (letter('-')) model.window().set_ui_scale(model.window().ui_scale() / 1.1f);
  if (letter('0')) model.window().set_ui_scale(1.0f);
  if (letter('Z', true)) shift ? model.presets().redo() : model.presets().undo();
  if (letter('Y', true)) model.presets().redo();
}

void look_or_follow(AppModel& model, bool follow) {
  if (follow)
    model.view().follow_contact = !model.view().follow_contact;
  else
    model.view().look_at_contact(model.tick_in_view());
}

}  // namespace

void handle_shortcuts(AppModel& model, MenuBar& menu, bool arrows) {
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
    if (letter(v.key[0])) model.view().look_from_standard(v.view);
  }
  model.devices().clutch().key = ImGui::IsKeyDown('C') && !io.KeyShift;
  if (letter('U')) model.view().set_y_up(!model.view().camera.y_up);
  if (letter('W')) model.solve_at_worst();
  if (letter('H')) model.solve_here();
  if (letter('G')) look_or_follow(model, io.KeyShift);
  if (letter('I')) io.KeyShift ? model.view().show_all() : model.view().isolate_marked();
  const int by = io.KeyShift ? 10 : 1;
  if (named(ImGuiKey_Space)) model.time().set_paused(!model.time().paused());
  if (arrows && named(ImGuiKey_LeftArrow, true)) model.time().step_tick(-by);
  if (arrows && named(ImGuiKey_RightArrow, true)) model.time().step_tick(by);
  if (letter(',', true)) model.time().step_iteration(-1);
  if (letter('.', true)) model.time().step_iteration(1);
  if (named(ImGuiKey_Home)) model.time().select_tick(model.time().first_tick());
  if (named(ImGuiKey_End)) model.time().go_live();
  if (letter('B')) model.presets().toggle_ab();
  if (letter('K')) model.time().add_bookmark();
  if (letter('[', true)) model.time().go_to_bookmark(-1);
  if (letter(']', true)) model.time().go_to_bookmark(1);
  if (letter('R')) model.record().recording() ? model.record().stop() : model.record().start();
  if (letter('F')) model.view().frame_scene();
  if (letter('M')) model.devices().set_hand_follows_mouse(!model.devices().hand_follows_mouse());
  // It has stopped the force already (App::frame).
  if (named(ImGuiKey_Escape) && !menu.path.open && !menu.palette.open) menu.sheet = false;
}

}  // namespace tangent
