// Preset slots A and B, undo and redo, and a table of the keys in which two presets differ.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>

namespace tangent {

namespace {

/// Presets that can be compared: A, B, the loaded file, the default values, then the folder's files.
constexpr std::size_t kOwn = 4;

std::vector<std::string> names_to_compare(const PresetModel& presets) {
  std::vector<std::string> names{"A", "B", "as loaded", "built-in"};
  for (const auto& file : presets.files()) names.push_back(file.label);
  return names;
}

/// The preset of a choice; files are read when chosen.
Preset chosen_preset(AppModel& model, ComparePanel::Side& side) {
  const PresetSlots& slots = model.presets().slots();
  if (side.choice < 2) return slots.slot(static_cast<std::size_t>(side.choice)).current();
  if (side.choice == 2) return model.presets().editor().loaded().preset;
  if (side.choice == 3) return Preset{};
  const auto& files = model.presets().files();
  const std::size_t file = static_cast<std::size_t>(side.choice) - kOwn;
  if (file >= files.size()) {
    side.choice = 2;
    return model.presets().editor().loaded().preset;
  }
  if (side.read != files[file].path) {
    side.read = files[file].path;
    const auto read = read_preset(side.read);
    if (!read) model.messages().say(Severity::error, read.error().message());
    side.preset = read ? read->preset : Preset{};
  }
  return side.preset;
}

void draw_slots(const UiContext& ui, PresetModel& presets) {
  const PresetSlots& slots = presets.slots();
  for (std::size_t i = 0; i < 2; ++i) {
    bool on = slots.active_slot() == i;
    const std::string text = std::string(" ") + slot_name(i) + " ";
    if (toggle_button(ui, std::string("compare/slot/") + slot_name(i), text.c_str(), on,
                      "The preset that is edited and rendered. B switches to the other one") &&
        on)
      presets.toggle_ab();
    ImGui::SameLine(0, ui.px(3));
  }
  const std::string copy = std::string("Copy to ") + slot_name(1 - slots.active_slot());
  if (text_button(ui, "compare/copy", copy.c_str(), "Copies the current values to the other one")) presets.copy_ab();
  ImGui::SameLine(0, ui.px(14));
  if (text_button(
          ui, "compare/undo", "Undo",
          slots.can_undo() ? ("Undoes: " + slots.undo_name() + " (Ctrl+Z)").c_str() : "Nothing to undo (Ctrl+Z)"))
    presets.undo();
  ImGui::SameLine(0, ui.px(3));
  if (text_button(
          ui, "compare/redo", "Redo",
          slots.can_redo() ? ("Redoes: " + slots.redo_name() + " (Ctrl+Y)").c_str() : "Nothing to redo (Ctrl+Y)"))
    presets.redo();
}

void draw_side(const UiContext& ui, const char* path, ComparePanel::Side& side, const std::vector<std::string>& names,
               float width) {
  std::vector<std::string_view> choices(names.begin(), names.end());
  side.choice = std::clamp(side.choice, 0, static_cast<int>(choices.size()) - 1);
  choice_row(ui, path, width, choices, side.choice);
  tooltip(ui, "What to compare: presets A and B, the loaded file, the built-in values, or a file of the folder");
}

void draw_differences(const UiContext& ui, PresetModel& presets, const std::vector<PresetChange>& changes,
                      float value_width) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float height = ui.px(18), width = ImGui::GetContentRegionAvail().x;
  ImFont* number = ui.fonts.small_number;
  for (const PresetChange& change : changes) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const std::string name = change.key->full_name();
    if (ImGui::InvisibleButton(("##diff/" + name).c_str(), {width, height})) presets.set_value(*change.key, change.now);
    ui.items.note_last("compare/key/" + name);
    if (ImGui::IsItemHovered()) draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.colours.accent_soft, ui.px(2));
    tooltip(ui, std::string(change.key->label) + ", " + name + "\n" + display_with_unit(*change.key, change.loaded) +
                    " on the left, " + display_with_unit(*change.key, change.now) +
                    " on the right. A click takes the right one over.");
    const auto value = [&](double v, float right) {
      const std::string text = display_with_unit(*change.key, v);
      const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, text.c_str()).x;
      draw.AddText(number, number->FontSize, {right - std::min(w, value_width - ui.px(4)), at.y + ui.px(3)},
                   ui.colours.text, text.c_str());
    };
    draw.PushClipRect(at, {at.x + width - 2.0f * value_width, at.y + height}, true);
    draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {at.x, at.y + ui.px(2)}, ui.colours.text_dim,
                 fitted(ui.fonts.small, std::string(change.key->label), width - 2.0f * value_width).c_str());
    draw.PopClipRect();
    value(change.loaded, at.x + width - value_width);
    value(change.now, at.x + width);
  }
}

}  // namespace

void draw_compare_panel(const UiContext& ui, AppModel& model, ComparePanel& state) {
  if (!section(ui, "Compare", state.open)) return;
  draw_slots(ui, model.presets());
  const std::vector<std::string> names = names_to_compare(model.presets());
  const float width = ImGui::GetContentRegionAvail().x;
  const float value_width = 0.33f * width;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({at.x + width - 2.0f * value_width, at.y});
  draw_side(ui, "compare/left", state.left, names, value_width - ui.px(3));
  ImGui::SameLine(0, ui.px(3));
  draw_side(ui, "compare/right", state.right, names, value_width);
  const Preset left = chosen_preset(model, state.left), right = chosen_preset(model, state.right);
  const auto changes = differences(left, right);
  if (changes.empty()) ImGui::TextDisabled("No key differs");
  draw_differences(ui, model.presets(), changes, value_width);
  const auto name_of = [&](const ComparePanel::Side& side) { return names[static_cast<std::size_t>(side.choice)]; };
  if (text_button(
          ui, "compare/solve", "Solve both",
          "Pauses, and solves the ticks from cursor A to B, or all of them, under the left preset and under the "
          "right one. The result is under Time machine; the right one is the pale curve and the planes beside") &&
      model.time().tick().record() != nullptr)
    model.time().compare({name_of(state.left), left}, {name_of(state.right), right});
  ImGui::SameLine(0, ui.px(6));
  toggle_button(
      ui, "compare/beside", "Both A and B", model.time().other_slot_beside,
      "Solves the tick in view with the other preset as well, also live, and shows its planes, path, error curve "
      "and table beside");
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
