#include "workbench/gui/plots/axes_drawing.h"

#include "workbench/gui/plots/tick_locator.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

double PlainAxis::share(double value) const {
  if (log) return std::log(std::max(value, 1e-300) / low) / std::log(high / low);
  return (value - low) / (high - low);
}

double PlainAxis::value_at(double share) const {
  return log ? low * std::pow(high / low, share) : low + share * (high - low);
}

PlotArea plain_area(const UiContext& ui, ImVec2 pos, ImVec2 size) {
  PlotArea area;
  area.pos = pos;
  area.size = size;
  area.gutter = ui.px(58);
  area.header = ui.px(20);
  area.min = {pos.x + area.gutter, pos.y + area.header};
  area.max = {pos.x + size.x - ui.px(12), pos.y + size.y - ui.px(20)};
  return area;
}

void draw_axes(const UiContext& ui, const PlainPlot& plot) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const PlotArea& area = plot.area;
  ImFont* font = ui.fonts.small_number;
  draw.AddRectFilled(area.min, area.max, ui.colours.plot);
  const int rows = std::max(1, static_cast<int>(area.height() / (2.2f * font->FontSize)));
  const int columns = std::max(1, static_cast<int>(area.width() / (5.5f * font->FontSize)));
  const auto ticks = [](const PlainAxis& axis, int most) {
    return axis.log ? log_ticks(axis.low, axis.high, most) : linear_ticks(axis.low, axis.high, most);
  };
  for (const AxisTick& tick : ticks(plot.y, rows)) {
    const float y = std::round(area.max.y - static_cast<float>(plot.y.share(tick.value)) * area.height());
    if (y < area.min.y - 1.0f || y > area.max.y + 1.0f) continue;
    draw.AddLine({area.min.x, y}, {area.max.x, y}, tick.major ? ui.colours.grid : ui.colours.grid_minor);
    if (!tick.major) continue;
    const float label_y =
        std::clamp(y - 0.5f * font->FontSize, area.min.y - 0.2f * font->FontSize, area.max.y - 0.9f * font->FontSize);
    text_at(draw, font, {area.min.x - ui.px(5) - text_width(font, tick.label.c_str()), label_y}, ui.colours.text_dim,
            tick.label.c_str());
  }
  const float unit_from = area.max.x - text_width(ui.fonts.small, plot.x.label.c_str());
  for (const AxisTick& tick : ticks(plot.x, columns)) {
    const float x = std::round(area.min.x + static_cast<float>(plot.x.share(tick.value)) * area.width());
    if (x < area.min.x - 1.0f || x > area.max.x + 1.0f) continue;
    draw.AddLine({x, area.min.y}, {x, area.max.y}, tick.major ? ui.colours.grid : ui.colours.grid_minor);
    if (!tick.major) continue;
    const float w = text_width(font, tick.label.c_str());
    if (x + 0.5f * w > unit_from - ui.px(6)) continue;
    text_at(draw, font, {std::max(x - 0.5f * w, area.pos.x), area.max.y + ui.px(3)}, ui.colours.text_dim,
            tick.label.c_str());
  }
  text_at(draw, ui.fonts.small, {unit_from, area.max.y + ui.px(3)}, ui.colours.text_dim, plot.x.label.c_str());
  const std::string title = fitted(ui.fonts.small, plot.y.label, area.width());
  text_at(draw, ui.fonts.small, {area.min.x, area.pos.y + ui.px(3)}, ui.colours.text, title.c_str());
}

}  // namespace tangent
