// Presets: the files in the preset folder, save as, and the changes since loading.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

namespace tangent {

namespace {

void draw_files(const UiContext& ui, PresetModel& presets) {
  if (presets.files().empty()) {
    ImGui::TextDisabled("No presets in %s", presets.folder().filename().c_str());
    return;
  }
  for (const auto& file : presets.files()) {
    const std::string name = file.stem().string();
    const bool current = file.stem() == presets.editor().path().stem() && !presets.editor().path().empty();
    if (ImGui::Selectable(name.c_str(), current)) presets.load(file);
    ui.items.note_last("presets/file/" + name);
    tooltip(ui, "Load " + file.string());
  }
}

void draw_changes(const UiContext& ui, PresetModel& presets) {
  const auto changes = presets.editor().changes();
  const std::string from = presets.editor().name();
  if (changes.empty()) {
    ImGui::TextDisabled("Nothing changed since %s", from.c_str());
    return;
  }
  ImGui::TextDisabled("Changed since %s", from.c_str());
  for (const PresetChange& change : changes) {
    const std::string name = change.key->full_name();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::string text =
        display_with_unit(*change.key, change.loaded) + " \u2192 " + display_with_unit(*change.key, change.now);
    ImGui::TextUnformatted(name.c_str());
    ImGui::PushFont(ui.fonts.small_number);
    const float w = ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorScreenPos({at.x + width - w - ui.px(22), at.y + ui.px(1)});
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopFont();
    ImGui::SetCursorScreenPos({at.x + width - ui.px(17), at.y - ui.px(3)});
    if (icon_button(ui, "presets/revert/" + name, Icon::reset, "Back to the loaded value"))
      presets.revert_value(*change.key);
    ImGui::SetCursorScreenPos({at.x, at.y + ui.px(19)});
  }
  ImGui::Dummy({1, 1});
  if (text_button(ui, "presets/revert_all", "Revert all", "Every key back to the loaded value")) presets.revert_all();
}

/// Overwriting an existing file takes a second press: shipped presets contain measurements.
void save(AppModel& model, PresetsPanel& state) {
  if (state.name != state.written && state.name != state.asked_for && model.presets().has(state.name)) {
    state.asked_for = state.name;
    model.messages().say(
        Severity::warning,
        "a preset \"" + state.name + "\" is there already; press Replace to write over it, or type another name");
    return;
  }
  state.asked_for.clear();
  const ContactScene* scene = model.scene().current().get();
  if (model.presets().save(state.name, scene != nullptr ? &scene->mesh() : nullptr, to_string(model.devices().names())))
    state.written = state.name;
}

}  // namespace

void draw_presets_panel(const UiContext& ui, AppModel& model, PresetsPanel& state) {
  if (!section(ui, "Presets", state.open)) return;
  draw_files(ui, model.presets());
  const bool replaces = !state.asked_for.empty() && state.asked_for == state.name;
  const char* const text = replaces ? "Replace" : "Save as";
  const float button = ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  const bool enter =
      ImGui::InputTextWithHint("##preset_name", "name", &state.name, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.items.note_last("presets/name");
  tooltip(ui, "Name of the file to save the current values in, without .toml");
  ImGui::SameLine();
  const bool pressed = text_button(ui, "presets/save", text,
                                   replaces ? "Overwrites the preset of this name and its measurements"
                                            : "Saves the current values in the preset folder under this name");
  if (enter || pressed) save(model, state);
  ImGui::Dummy({1, ui.px(1)});
  draw_changes(ui, model.presets());
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
