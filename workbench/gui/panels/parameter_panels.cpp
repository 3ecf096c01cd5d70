// Favourites, then the tables of the preset schema, one row per key.
#include "core/io/rendering_condition.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

namespace tangent {

namespace {

bool holds(const KeyCondition& condition, const Preset& preset) {
  return condition.holds == nullptr || condition.holds(preset);
}

/// Whether a key applies under the current choices; others are hidden.
bool has_meaning(const PresetKey& key, const Preset& preset) {
  return !key.condition.otherwise.empty() || holds(key.condition, preset);
}

/// "the method "paper"", "the methods "newton" and "robust"".
std::string method_names(Methods methods) {
  std::vector<std::string> quoted;
  for (std::size_t i = 0; i < kMethodNames.size(); ++i)
    if (methods.has(static_cast<Method>(i))) quoted.push_back("\"" + std::string(kMethodNames[i]) + "\"");
  std::string text = quoted.size() == 1 ? "the method " : "the methods ";
  for (std::size_t i = 0; i < quoted.size(); ++i)
    text += (i == 0 ? "" : i + 1 == quoted.size() ? " and " : ", ") + quoted[i];
  return text;
}

/// Why a value currently has no effect; empty: it has.
std::string idle_because(const PresetKey& key, const AppModel& model) {
  const Preset& preset = model.presets().current();
  if (key.needs_controller) {
    const DisplayCapabilities* display =
        model.devices().session() != nullptr ? model.devices().session()->display_capabilities() : nullptr;
    if (display == nullptr || !display->has_controller) return "The chosen display has no controller for it.";
  }
  if (key.planar_only && (model.scene().current() == nullptr || model.scene().current()->planar() == nullptr))
    return "Used in 2D scenes only.";
  if (key.read_by != kNoMethod && !key.read_by.has(preset.solver.method))
    return "Used by " + method_names(key.read_by) + " only.";
  return holds(key.condition, preset) ? "" : std::string(key.condition.otherwise);
}

/// What is known of a key's values in the simulated hand, for its slider.
std::vector<ShareBand> bands_of(const PresetKey& key, const SafeRange& range, const GuardModel& guard) {
  std::vector<ShareBand> out;
  if (range.samples().empty() && guard.guards() && is_in_loop(key)) out.push_back({0.0f, 1.0f, Safety::unknown});
  for (const RangePiece& piece : range.pieces()) {
    const auto share = [&](double value) {
      const auto n = static_cast<double>(key.choices.size());
      return static_cast<float>(key.kind == KeyKind::choice ? (value + 0.5) / n : slider_share(key, value));
    };
    if (share(piece.to) > share(piece.from)) out.push_back({share(piece.from), share(piece.to), piece.safety});
  }
  return out;
}

/// The same for its tooltip, with the legend.
std::string known_of(const PresetKey& key, const SafeRange& range, const GuardModel& guard) {
  if (range.samples().empty())
    return guard.guards() && is_in_loop(key) ? "\n\nDots: not known yet in the simulated hand; a change is asked about."
                                             : "";
  std::string text = "\n\nIn the simulated hand (line: stable; teeth: shakes; dots: not known): ";
  if (key.kind != KeyKind::choice)
    return text +
           range_words(range,
                       [unit = display_unit(key)](double value) {
                         return printed("%.4g", value / unit.scale) + " " + std::string(unit.name);
                       }) +
           ".";
  for (const SafeRange::Sample& sample : range.samples())
    text += (&sample == &range.samples().front() ? "" : ", ") + key.value_text(sample.value) + " " +
            (sample.verdict.safety == Safety::unknown ? "is not known" : to_string(sample.verdict.safety));
  return text + ".";
}

std::string explain(const PresetKey& key, std::string_view idle) {
  std::string text(key.doc);
  if (key.kind != KeyKind::choice) text += "\n\nAllowed: " + display_range(key);
  text += "\nKey: " + key.full_name();
  if (!key.option.empty()) text += ", --" + std::string(key.option);
  if (!idle.empty()) text += "\n" + std::string(idle);
  text += "\nA click on the name makes it a favourite.";
  return text;
}

/// The key's name, with a star for a favourite and a dot for a changed value; a click toggles the favourite.
void draw_label(const UiContext& ui, AppModel& model, const PresetKey& key, const std::string& path, float width,
                std::string_view idle) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::InvisibleButton(("##label/" + path).c_str(), {width, ImGui::GetFrameHeight()}))
    model.window().toggle_favourite(key);
  ui.items.note_last(path + "/label");
  const bool hovered = ImGui::IsItemHovered();
  tooltip(ui, explain(key, idle));
  const float text_y = std::round(at.y + 0.5f * (ImGui::GetFrameHeight() - ui.fonts.text->FontSize));
  const ImVec2 mark{at.x + ui.px(2), text_y + 0.55f * ui.fonts.text->FontSize};
  const bool changed = key.get(model.presets().current()) != key.get(model.presets().editor().loaded().preset);
  if (changed)
    draw.AddCircleFilled(mark, ui.px(2.5f), ui.colours.accent);
  else if (hovered || model.window().is_favourite(key))
    draw_star(draw, mark, ui.px(4.5f), hovered ? ui.colours.text_dim : ui.colours.warning);
  draw.PushClipRect(at, {at.x + width, at.y + ImGui::GetFrameHeight()}, true);
  const std::string label(key.label);
  draw.AddText({at.x + ui.px(9), text_y}, !idle.empty() ? ui.colours.text_faint : ui.colours.text, label.c_str());
  draw.PopClipRect();
}

/// A hundredth of the slider, or what changes a whole number by one.
double arrow_step(const PresetKey& key, double value) {
  constexpr double kShare = 0.01;
  if (key.kind != KeyKind::integer) return kShare;
  const double one = slider_share(key, value + 1.0) - slider_share(key, value);
  return std::max(kShare, one);
}

/// `prefix`: of the item's path, for a key drawn twice.
void draw_row(const UiContext& ui, AppModel& model, const PresetKey& key, const char* prefix = "") {
  const Preset& preset = model.presets().current();
  const double value = key.get(preset);
  const std::string path = prefix + std::string(key.table) + "/" + std::string(key.key);
  const std::string idle = idle_because(key, model);
  const float width = ImGui::GetContentRegionAvail().x;
  const float label_width = std::max(ui.px(128), 0.42f * width);
  const float reset_width = ui.px(20);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_label(ui, model, key, path, label_width - ui.px(4), idle);

  ImGui::SetCursorScreenPos({at.x + label_width, at.y});
  const float field_width = width - label_width - reset_width;
  const SafeRange range = model.guard().range(key);
  std::vector<ShareBand> bands;
  if (idle.empty()) bands = bands_of(key, range, model.guard());
  if (key.kind == KeyKind::choice) {
    int chosen = static_cast<int>(value);
    if (choice_row(ui, path, field_width, key.choices, chosen)) model.presets().set_value(key, chosen);
    draw_bands(ui, {at.x + label_width, at.y}, field_width, bands);
  } else {
    const DisplayUnit unit = display_unit(key);
    const auto result = value_field(
        ui, path,
        {field_width, slider_share(key, value), display_text(key, value), unit.name, arrow_step(key, value), bands});
    if (result.slid) model.presets().slide_value(key, slider_value(key, *result.slid));
    if (result.typed) model.presets().type_value(key, *result.typed);
  }
  tooltip(ui, explain(key, idle) + (idle.empty() ? known_of(key, range, model.guard()) : ""));

  ImGui::SetCursorScreenPos({at.x + width - reset_width + ui.px(3), at.y});
  if (value != key.default_value()) {
    const std::string what = "Back to " + display_with_unit(key, key.default_value()) + ", the built-in value";
    if (icon_button(ui, path + "/reset", Icon::reset, what.c_str())) model.presets().reset_value(key);
  } else {
    ImGui::Dummy({ui.px(10), ImGui::GetFrameHeight()});
  }
}

void draw_favourites(const UiContext& ui, AppModel& model) {
  if (model.window().favourites().empty() || !section(ui, "Favourites", true)) return;
  for (const PresetKey& key : preset_keys()) {
    if (model.window().is_favourite(key)) draw_row(ui, model, key, "favourites/");
  }
  ImGui::Dummy({1, ui.px(2)});
}

/// The paper's conditions by name; sets both sources.
void draw_condition_row(const UiContext& ui, PresetModel& presets) {
  const RenderingCondition* present = condition_of(presets.current());
  std::array<std::string_view, kConditionNames.size() + 1> names{"own combination"};
  std::copy(kConditionNames.begin(), kConditionNames.end(), names.begin() + 1);
  const float width = ImGui::GetContentRegionAvail().x, label_width = std::max(ui.px(128), 0.42f * width);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::AlignTextToFramePadding();
  ImGui::SetCursorScreenPos({at.x + ui.px(9), at.y});
  ImGui::TextUnformatted("Condition");
  ImGui::SetCursorScreenPos({at.x + label_width, at.y});
  int chosen = present != nullptr ? static_cast<int>(present - kRenderingConditions.data()) + 1 : 0;
  if (choice_row(ui, "force/condition", width - label_width - ui.px(20), names, chosen) && chosen > 0)
    presets.set_condition(kRenderingConditions[static_cast<std::size_t>(chosen - 1)]);
  tooltip(ui, "The paper's rendering conditions: sources of force and display together. " +
                  (present != nullptr ? std::string(present->words)
                                      : std::string("The sources chosen here are a combination of your own")));
}

void draw_table(const UiContext& ui, AppModel& model, const PresetTable& table) {
  if (!section(ui, table.title.data(), !table.seldom)) return;
  for (const PresetKey& key : preset_keys()) {
    if (key.table == table.name && has_meaning(key, model.presets().current())) draw_row(ui, model, key);
  }
  if (table.name == "solver") draw_gain_advice(ui, model);
  if (table.name == "force") draw_condition_row(ui, model.presets());
  ImGui::Dummy({1, ui.px(2)});
}

}  // namespace

void draw_parameter_panels(const UiContext& ui, AppModel& model) {
  draw_favourites(ui, model);
  for (const PresetTable& table : preset_tables()) draw_table(ui, model, table);
}

}  // namespace tangent
