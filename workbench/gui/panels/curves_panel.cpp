// Speed against error on the chosen ticks: start, plot, legend, and which method is the fastest for an error.
#include "workbench/bench/speed_curves.h"
#include "workbench/gui/panels/curves_plot.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

void draw_measuring(const UiContext& ui, AppModel& model) {
  CurvesModel& curves = model.curves();
  if (curves.running()) {
    if (text_button(ui, "speed/cancel", "Cancel", "Stops and keeps the rounds so far")) curves.cancel();
    ImGui::SameLine();
    const auto shown = curves.curves();
    ImGui::TextDisabled("%.0f %%, %d rounds", 100.0 * curves.progress(), shown ? shown->rounds : 0);
    return;
  }
  const char* label = model.time().selection_kept() ? "Measure A to B" : "Measure the recorded ticks";
  if (text_button(ui, "speed/start", label,
                  "Solves these ticks by every method at many tolerances and iteration limits, in turns, in the "
                  "background, and times them; of more than 20,000 ticks the newest. Cursors A and B choose the ticks"))
    curves.start();
  if (curves.curves() == nullptr) return;
  ImGui::SameLine(0, ui.px(4));
  if (text_button(ui, "speed/clear", "Clear", "Deletes the curves")) curves.clear();
}

/// What the axes show.
void draw_axes_choice(const UiContext& ui, CurvesModel& curves) {
  const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ui.px(4));
  int time = static_cast<int>(curves.shown_time), error = static_cast<int>(curves.shown_error);
  if (choice_row(ui, "speed/time", half, CurvesModel::kTimeNames, time))
    curves.shown_time = static_cast<CurvesModel::Time>(time);
  tooltip(ui, "Upwards: time of a tick. Bars: its interval over the rounds");
  ImGui::SameLine(0, ui.px(4));
  if (choice_row(ui, "speed/error", half, CurvesModel::kErrorNames, error))
    curves.shown_error = static_cast<CurvesModel::Error>(error);
  tooltip(ui, "To the right: distance of the contact from the exact one, which is iterated on to 1e-12 of the object");
}

/// Markers with names, as many in a line as have room.
void draw_key(const UiContext& ui, const bench::SpeedCurves& curves) {
  const float line = ImGui::GetTextLineHeight();
  const auto entry = [&](const char* name, const auto& mark) {
    const float w = ui.px(14) + ImGui::CalcTextSize(name).x;
    same_line_if_room(w + ui.px(8));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    mark(ImVec2{at.x + ui.px(5), at.y + 0.5f * line});
    ImGui::GetWindowDrawList()->AddText({at.x + ui.px(14), at.y}, ui.colours.text_dim, name);
    ImGui::Dummy({w, line});
  };
  for (const Method method : bench::kMeasuredMethods)
    entry(to_string(method), [&](ImVec2 at) { draw_method_marker(ui, method, at, ui.px(3)); });
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  entry("preset", [&](ImVec2 at) { draw.AddCircle(at, ui.px(4.5f), ui.colours.text, 20, ui.px(1.2f)); });
  if (!curves.peers.empty())
    entry("other libraries", [&](ImVec2 at) {
      const float r = ui.px(4);
      draw.AddQuad({at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, {at.x - r, at.y}, ui.colours.text_dim,
                   ui.px(1.3f));
    });
}

/// "1 um: newton 145 ns; tie robust".
std::string level_text(const bench::SpeedCurves& curves, const bench::ErrorLevel& level) {
  const auto exponent = static_cast<int>(std::lround(std::log10(level.error_m)));
  const std::array units{"pm", "nm", "\u00b5m", "mm"};
  const int unit = std::clamp((exponent + 12) / 3, 0, 3);
  std::string text =
      printed("%.0f %s: ", std::pow(10.0, exponent + 12 - 3 * unit), units[static_cast<std::size_t>(unit)]);
  for (std::size_t i = 0; i < level.methods.size(); ++i) {
    const bench::LevelEntry& entry = level.methods[i];
    const bench::CurvePoint& p = curves.points[entry.point];
    const char* name = to_string(p.setting.method);
    text += i == 0      ? printed("%s %.0f ns", name, p.times.typical_ns.median)
            : entry.tie ? printed(", %s tie", name)
                        : printed(", %s %.3g\u00d7", name, entry.to_fastest.ratio);
  }
  return text;
}

void draw_levels(const UiContext& ui, const bench::SpeedCurves& curves) {
  ImGui::TextDisabled("Fastest typical tick for a 99 %% error of at most");
  ui.items.note_last("speed/levels");
  tooltip(
      ui,
      "Of each method its fastest point that is as exact. A tie takes less than 3 % longer than the fastest, or may "
      "within the 95 % interval of the ratio, from times of the same round");
  ImGui::PushTextWrapPos(0.0f);
  for (const bench::ErrorLevel& level : curves.levels) {
    const auto exponent = std::lround(std::log10(level.error_m));
    if (exponent % 3 == 0) ImGui::TextUnformatted(level_text(curves, level).c_str());
  }
  ImGui::PopTextWrapPos();
}

}  // namespace

void open_curve_point(AppModel& model, std::size_t i) {
  model.curves().open(i);
  model.view().toggles.planes = true;
}

void draw_curves_panel(const UiContext& ui, AppModel& model, FoldedPanel& state) {
  if (!section(ui, "Speed against error", state.open)) return;
  CurvesModel& curves = model.curves();
  ImGui::PushFont(ui.fonts.small);
  draw_measuring(ui, model);
  const auto shown = curves.curves();
  if (shown != nullptr) {
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("Ticks %llu to %llu, %d rounds, intervals %.0f %%%s",
                        static_cast<unsigned long long>(curves.range().from),
                        static_cast<unsigned long long>(curves.range().to), shown->rounds, 100.0 * shown->coverage,
                        curves.outdated() ? "; other values have changed since" : "");
    ImGui::PopTextWrapPos();
    ui.items.note_last("speed/range");
    draw_axes_choice(ui, curves);
    draw_curves_plot(ui, model, *shown);
    draw_key(ui, *shown);
    draw_levels(ui, *shown);
  }
  ImGui::PopFont();
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
