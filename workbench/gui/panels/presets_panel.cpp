// Presets: the files in the preset folder, save as, and the changes since loading.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

#include <algorithm>

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

bool save_preset(AppModel& model, const std::string& name, const std::string& note) {
  if (!model.presets().save(name, origin_of(model, note))) return false;
  if (model.evidence().wanted() && model.evidence().can_attach()) model.evidence().attach_selection();
  return true;
}

namespace {

/// Beside the name of the file that is loaded: whether it holds.
void draw_outcome(const UiContext& ui, EvidenceModel& evidence) {
  const std::string label = evidence.label();
  if (label.empty()) return;
  const PresetCheck* check = evidence.result();
  const Rgba ink = check == nullptr                          ? ui.palette.text_dim
                   : check->outcome == CheckOutcome::holds   ? ui.palette.good
                   : check->outcome == CheckOutcome::changed ? ui.palette.bad
                                                             : ui.palette.warning;
  ImGui::SameLine(std::max(0.0f, ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(label.c_str()).x));
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(packed(ink)), "%s", label.c_str());
}

void draw_evidence(const UiContext& ui, AppModel& model) {
  EvidenceModel& evidence = model.evidence();
  if (evidence.running()) {
    if (text_button(ui, "presets/cancel_check", "Cancel", "Stops measuring at once")) evidence.cancel();
  } else if (text_button(ui, "presets/check", "Check",
                         "Measures again what the loaded preset says was measured with it")) {
    evidence.check();
  }
  ImGui::SameLine();
  bool wanted = evidence.wanted();
  if (toggle_button(ui, "presets/attach", "Attach selection", wanted,
                    "Saving also keeps the selected ticks (cursors A and B) as evidence: their poses in a file beside "
                    "the preset, and what the solver measures along them"))
    evidence.set_wanted(wanted);
}

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
    const PresetCheck* check = file.path == chosen ? model.evidence().result() : nullptr;
    tooltip(ui, "Load " + file.path.string() + (check != nullptr ? "\nIts evidence " + check_text(*check) : ""));
    if (file.path == chosen) draw_outcome(ui, model.evidence());
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
  if (save_preset(model, state.name, model.presets().note_to_save())) state.written = state.name;
}

void draw_save(const UiContext& ui, AppModel& model, PresetsPanel& state) {
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
  ImGui::InputTextWithHint("##preset_note", "note", &model.presets().note_to_save());
  ui.items.note_last("presets/note");
  if (auto given = ui.items.take_value("presets/note")) model.presets().note_to_save() = *given;
  tooltip(ui, "A note about these values; saved with them");
  if (enter || pressed) save(model, state);
}

}  // namespace

void draw_presets_panel(const UiContext& ui, AppModel& model, PresetsPanel& state) {
  if (!section(ui, "Presets", state.open)) return;
  draw_save(ui, model, state);
  draw_evidence(ui, model);
  ImGui::Dummy({1, ui.px(1)});
  draw_changes(ui, model.presets());
  ImGui::Dummy({1, ui.px(3)});
  draw_files(ui, model);
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
