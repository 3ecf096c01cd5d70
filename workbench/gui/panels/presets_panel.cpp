// Presets: the files in the preset folder, save as, and the changes since loading.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

namespace tangent {

PresetOrigin origin_of(const AppModel& model, const std::string& note) {
  const Session* session = model.devices().session();
  return {.mesh = model.mesh(),
          .metres_per_unit = model.scene().metres_per_unit(),
          .devices = to_string(model.devices().names()),
          .history = session != nullptr ? &session->history() : nullptr,
          .preset_id = session != nullptr ? session->preset_id() : 0,
          .note = note};
}

namespace {

void draw_files(const UiContext& ui, AppModel& model) {
  PresetModel& presets = model.presets();
  const std::filesystem::path chosen = presets.editor().path();
  if (ImGui::Selectable("built-in", chosen.empty() && presets.editor().name() == "built-in")) presets.load_built_in();
  ui.items.note_last("presets/built_in");
  tooltip(ui, "The values built into the program, from no file");
  const std::vector<PresetEntry> files = presets.files();  // loading one may change the list
  for (const PresetEntry& file : files) {
    if (ImGui::Selectable(file.label.c_str(), file.path == chosen)) presets.load(file.path, model.mesh());
    ui.items.note_last("presets/file/" + file.label);
    tooltip(ui, "Load " + file.path.string());
  }
}

void draw_changes(const UiContext& ui, PresetModel& presets) {
  const auto changes = presets.editor().changes();
  const std::string from = presets.editor().name() + " (" + slot_name(presets.slots().active_slot()) + ")";
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
        "a preset \"" + state.name + "\" is there already; press Replace to overwrite it, or type another name");
    return;
  }
  state.asked_for.clear();
  if (model.presets().save(state.name, origin_of(model, state.note))) state.written = state.name;
}

void draw_save(const UiContext& ui, AppModel& model, PresetsPanel& state) {
  const std::string& from = model.presets().editor().path().native();
  if (state.note_of != from) {
    state.note_of = from;
    state.note = model.presets().editor().loaded().about.note;
  }
  const bool replaces = !state.asked_for.empty() && state.asked_for == state.name;
  const char* const text = replaces ? "Replace" : "Save as";
  const float button = ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  const bool enter =
      ImGui::InputTextWithHint("##preset_name", "name", &state.name, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.items.note_last("presets/name");
  if (auto given = ui.items.take_value("presets/name")) state.name = *given;
  tooltip(ui, "Name of the file to save the current values in, without .toml");
  ImGui::SameLine();
  const std::string tip = replaces ? "Overwrites the preset of this name and its measurements"
                                   : "Saves the current values in " + model.presets().folder().string();
  const bool pressed = text_button(ui, "presets/save", text, tip.c_str());
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  ImGui::InputTextWithHint("##preset_note", "note", &state.note);
  ui.items.note_last("presets/note");
  if (auto given = ui.items.take_value("presets/note")) state.note = *given;
  tooltip(ui, "A note about these values; saved with them");
  if (enter || pressed) save(model, state);
}

}  // namespace

void draw_presets_panel(const UiContext& ui, AppModel& model, PresetsPanel& state) {
  if (!section(ui, "Presets", state.open)) return;
  draw_save(ui, model, state);
  ImGui::Dummy({1, ui.px(1)});
  draw_changes(ui, model.presets());
  ImGui::Dummy({1, ui.px(3)});
  draw_files(ui, model);
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
