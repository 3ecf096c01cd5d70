// Error against iteration for the tick in view, on a log axis, coloured by order as in the 3D view.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/plots/curve_drawing.h"
#include "workbench/gui/plots/tick_locator.h"
#include "workbench/gui/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kFloor_um = 1e-7;  ///< errors of 0 are drawn here: about the rounding of a 40 mm coordinate

/// Whole decades that hold every error and the tolerance.
std::pair<double, double> error_range_um(std::span<const IterationRecord> iterations, double tolerance_um) {
  double low = tolerance_um, high = tolerance_um * 10.0;
  for (const IterationRecord& r : iterations) {
    const double e = std::max(r.error_m * 1e6, kFloor_um);
    low = std::min(low, e);
    high = std::max(high, e);
  }
  return {std::pow(10.0, std::floor(std::log10(low) + 1e-9)), std::pow(10.0, std::ceil(std::log10(high) - 1e-9))};
}

}  // namespace

void draw_error_plot(const UiContext& ui, AppModel& model, bool&) {
  const auto iterations = model.tick().iterations();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.px(132);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("##error_plot", {std::max(width, 1.0f), height});
  ui.items.note_last("iterations/error_plot");
  const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small_number;
  const auto width_of = [font](const std::string& s) { return font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, s.c_str()).x; };
  const ImVec2 min{at.x + ui.px(40), at.y + ui.px(18)}, max{at.x + width - ui.px(6), at.y + height - ui.px(18)};
  if (max.x - min.x < ui.px(40)) return;
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {min.x, at.y + ui.px(2)}, ui.colours.text, "Error");
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {min.x + ui.px(34), at.y + ui.px(2)}, ui.colours.text_dim, "\u00b5m, by iteration");
  draw.AddRectFilled(min, max, ui.colours.plot);

  const double tolerance_um = model.presets().current().solver.tolerance_m * 1e6;
  const auto [low, high] = error_range_um(iterations, tolerance_um);
  const auto y_of = [&, low = low, high = high](double um) {
    const double share = std::log10(std::max(um, low) / low) / std::log10(high / low);
    return max.y - static_cast<float>(share) * (max.y - min.y);
  };
  for (const AxisTick& tick : log_ticks(low, high, 5)) {
    const float y = std::round(y_of(tick.value));
    draw.AddLine({min.x, y}, {max.x, y}, tick.major ? ui.colours.grid : ui.colours.grid_minor);
    if (tick.major) draw.AddText(font, font->FontSize, {min.x - ui.px(5) - width_of(tick.label), y - 0.5f * font->FontSize}, ui.colours.text_dim, tick.label.c_str());
  }
  const double count = std::max<double>(4.0, static_cast<double>(iterations.size()) - 1.0);
  const float inset = ui.px(8);
  const auto x_of = [&](double i) { return min.x + inset + static_cast<float>(i / count) * (max.x - min.x - 2.0f * inset); };
  for (const AxisTick& tick : linear_ticks(0.0, count, 8)) {
    if (!tick.major || tick.value != std::floor(tick.value)) continue;
    const float x = std::round(x_of(tick.value));
    draw.AddLine({x, min.y}, {x, max.y}, ui.colours.grid_minor);
    const std::string label = printed("%.0f", tick.value);
    draw.AddText(font, font->FontSize, {x - 0.5f * width_of(label), max.y + ui.px(2)}, ui.colours.text_dim, label.c_str());
  }
  draw.PushClipRect(min, max, true);
  draw_dashed_horizontal(draw, min.x, max.x, std::round(y_of(tolerance_um)), ui.px(4), ui.colours.text_dim, ui.px(1));
  draw.PopClipRect();
  if (iterations.empty()) return;

  const float spacing = static_cast<float>(1.0 / count) * (max.x - min.x - 2.0f * inset);
  const float radius = std::clamp(0.38f * spacing, ui.px(1.3f), ui.px(3.2f));
  std::optional<std::size_t> nearest;
  float nearest_distance = ui.px(14);
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const ImVec2 p{x_of(static_cast<double>(i)), y_of(std::max(iterations[i].error_m * 1e6, kFloor_um))};
    if (i > 0) {
      const ImVec2 before{x_of(static_cast<double>(i) - 1.0), y_of(std::max(iterations[i - 1].error_m * 1e6, kFloor_um))};
      // A new seed starts somewhere else: no line from the last one to it.
      if (iterations[i].seed == iterations[i - 1].seed) draw.AddLine(before, p, packed(with_alpha(ui.palette.error, 0.55f)), ui.px(1.3f));
    }
    const float d = std::hypot(ImGui::GetIO().MousePos.x - p.x, ImGui::GetIO().MousePos.y - p.y);
    if (d < nearest_distance) {
      nearest_distance = d;
      nearest = i;
    }
  }
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const ImVec2 p{x_of(static_cast<double>(i)), y_of(std::max(iterations[i].error_m * 1e6, kFloor_um))};
    const bool marked = model.tick().selected() == i || (hovered && nearest == i);
    draw.AddCircleFilled(p, marked ? ui.px(4.5f) : radius, packed(iteration_colour(i, iterations.size())), 16);
    if (marked) draw.AddCircle(p, ui.px(6.5f), ui.colours.text, 20, ui.px(1.2f));
  }
  if (!hovered || !nearest) return;
  ImGui::SetTooltip("iteration %zu: %s \u00b5m", *nearest, short_number(iterations[*nearest].error_m * 1e6).c_str());
  if (clicked) {
    model.set_paused(true);
    model.tick().select(nearest);
  }
}

}  // namespace tangent
