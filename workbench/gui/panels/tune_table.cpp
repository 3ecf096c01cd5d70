// The brushed trials as a table, without a brush the front; and what one does with a trial that is tried.
#include "workbench/gui/panels/tune_parts.h"
#include "workbench/gui/plots/plot_area.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>

namespace tangent {

namespace {

constexpr std::size_t kMostTrialRows = 6;  ///< in view

/// A column: what it is called, and its numbers.
struct TrialColumn {
  std::string heading;
  TuneAxis of;
  double in_si = 1.0;
  float width = 0.0f;
  std::string text(const sweep::Trial& trial) const { return printed("%.4g", of.of(trial) / in_si); }
};

/// Objectives, then keys, as far as there is room.
std::vector<TrialColumn> trial_columns(const UiContext& ui, const TuneModel& tune, float room) {
  std::vector<TrialColumn> out;
  const auto add = [&](std::string heading, TuneAxis of, double in_si) {
    const float width = std::max(text_width(ui.fonts.small_number, "0.00e-00"),
                                 std::min(text_width(ui.fonts.small, heading.c_str()), ui.px(84)));
    room -= width + ui.px(8);
    if (room < 0.0f && !out.empty()) return false;
    out.push_back({std::move(heading), of, in_si, width});
    return true;
  };
  const TuneQuestion& asked = tune.asked();
  for (std::size_t i = 0; i < asked.objectives.size(); ++i)
    if (!add(column_with_unit(*asked.objectives[i].column), {false, i}, column_unit(*asked.objectives[i].column).in_si))
      return out;
  for (std::size_t i = 0; i < asked.ranges.size(); ++i) {
    const DisplayUnit unit = display_unit(*asked.ranges[i].key);
    std::string name(asked.ranges[i].key->label);
    if (const std::size_t gain = name.find("G_"); gain != std::string::npos) name = name.substr(gain);
    if (!unit.name.empty()) name += ", " + std::string(unit.name);
    if (!add(std::move(name), {true, i}, unit.scale)) return out;
  }
  return out;
}

float number_room(const UiContext& ui) { return text_width(ui.fonts.small_number, "00000"); }

void draw_headings(const UiContext& ui, const std::vector<TrialColumn>& columns) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  float x = at.x + number_room(ui);
  for (const TrialColumn& column : columns) {
    const std::string text = fitted(ui.fonts.small, column.heading, column.width);
    x += column.width + ui.px(8);
    text_at(draw, ui.fonts.small, {x - text_width(ui.fonts.small, text.c_str()), at.y}, ui.colours.text_dim,
            text.c_str());
  }
  ImGui::Dummy({ImGui::GetContentRegionAvail().x, ui.fonts.small->FontSize});
}

void draw_trial_row(const UiContext& ui, TuneModel& tune, const std::vector<TrialColumn>& columns, std::size_t trial) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImFont* font = ui.fonts.small_number;
  const float width = ImGui::GetContentRegionAvail().x, height = font->FontSize + ui.px(4);
  const std::string path = printed("tune/trial/%zu", trial);
  const bool pressed = ImGui::InvisibleButton(path.c_str(), {width, height});
  ui.items.note_last(path);
  tooltip(ui, trial_text(tune, trial) + "\nClick: try it");
  const bool in_use = tune.in_use() == trial;
  if (in_use || ImGui::IsItemHovered())
    draw.AddRectFilled(at, {at.x + width, at.y + height}, in_use ? ui.colours.accent_fill : ui.colours.accent_soft,
                       ui.px(2));
  const sweep::Trial& t = tune.trials()[trial];
  const float y = at.y + ui.px(2);
  const std::string number = std::to_string(trial + 1) + (t.missed > 0.0 ? "\u00d7" : "");
  text_at(draw, font, {at.x + ui.px(2), y}, t.missed > 0.0 ? ui.colours.warning : ui.colours.text_dim, number.c_str());
  float x = at.x + number_room(ui);
  for (const TrialColumn& column : columns) {
    x += column.width + ui.px(8);
    const std::string text = column.text(t);
    text_at(draw, font, {x - text_width(font, text.c_str()), y}, ui.colours.text, text.c_str());
  }
  if (pressed) tune.try_trial(trial);
}

std::string verdict_text(const TuneModel& tune) {
  const sweep::FrontVerdict& verdict = *tune.verdict();
  const auto numbers = [&](const sweep::Trial& trial) {
    std::string out;
    for (std::size_t i = 0; i < trial.objectives.size(); ++i) {
      const sweep::NumberColumn& column = *tune.asked().objectives[i].column;
      const UnitLabel unit = column_unit(column);
      out += (i > 0 ? ", " : "") + printed("%.4g", trial.objectives[i] / unit.in_si) +
             (unit.name.empty() ? "" : " " + std::string(unit.name));
    }
    return out;
  };
  return printed("On the ticks held back: trial %zu, the middle of the front, ", verdict.chosen + 1) +
         numbers(verdict.mine) + "; trial 1 " + numbers(verdict.start) +
         (verdict.clearly ? ". It is clearly better" : ". It is not clearly better: trial 1 is simpler");
}

}  // namespace

std::string trial_text(const TuneModel& tune, std::size_t trial) {
  const sweep::Trial& t = tune.trials()[trial];
  const TuneQuestion& asked = tune.asked();
  std::string out = printed("Trial %zu", trial + 1);
  if (trial == 0) out += ": " + std::string("where the search began");
  for (std::size_t i = 0; i < asked.objectives.size(); ++i) {
    const sweep::NumberColumn& column = *asked.objectives[i].column;
    const UnitLabel unit = column_unit(column);
    out += "\n" + column_label(column) + printed(" %.5g ", t.objectives[i] / unit.in_si) + std::string(unit.name);
  }
  for (std::size_t i = 0; i < asked.ranges.size(); ++i)
    out += "\n" + std::string(asked.ranges[i].key->label) + " " + display_with_unit(*asked.ranges[i].key, t.values[i]);
  for (const sweep::Constraint& constraint : asked.constraints)
    if (!constraint.holds(t.numbers))
      out += "\nbreaks " + constraint.text() + printed(": %.5g", constraint.of.of(t.numbers));
  return out;
}

void draw_tune_table(const UiContext& ui, AppModel& model) {
  TuneModel& tune = model.tune();
  const auto& listed = tune.listed();
  const float row = ui.fonts.small_number->FontSize + ui.px(4);
  const float width = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
  const std::vector<TrialColumn> columns = trial_columns(ui, tune, width - number_room(ui));
  draw_headings(ui, columns);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::BeginChild("tune_trials",
                    {0.0f, row * static_cast<float>(std::clamp<std::size_t>(listed.size(), 1, kMostTrialRows))});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(listed.size()), row);
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      draw_trial_row(ui, tune, columns, listed[static_cast<std::size_t>(i)]);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  if (tune.verdict()) draw_tune_text(ui, verdict_text(tune), ui.colours.text_dim);
}

}  // namespace tangent
