#include "workbench/gui/experiment/operator_plots.h"

#include "workbench/gui/plots/axes_drawing.h"
#include "workbench/gui/plots/curve_drawing.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// The next round number that is not below.
double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-6))));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0})
    if (step * decade >= value * (1.0 - 1e-9)) return step * decade;
  return 10.0 * decade;
}

void draw_answer(const UiContext& ui, ImVec2 at, const StaircasePoint& point) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float r = ui.px(3.5f);
  if (point.right) {
    draw.AddCircleFilled(at, r, ui.colours.good, 16);
  } else {
    draw.AddLine({at.x - r, at.y - r}, {at.x + r, at.y + r}, ui.colours.bad, ui.px(2));
    draw.AddLine({at.x - r, at.y + r}, {at.x + r, at.y - r}, ui.colours.bad, ui.px(2));
  }
  if (point.reversal) draw.AddCircle(at, 2.0f * r, ui.colours.text, 20, ui.px(1.3f));
}

/// Beside the heading, from the right edge on.
void draw_key(const UiContext& ui, const PlotArea& area) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float y = area.pos.y + ui.px(3) + 0.5f * ui.fonts.small->FontSize;
  float x = area.max.x;
  constexpr StaircasePoint kPoints[]{{0, true, true}, {0, false, false}, {0, true, false}};
  constexpr const char* kWords[]{"reversal", "wrong", "right"};
  for (int i = 0; i < 3; ++i) {
    x -= text_width(ui.fonts.small, kWords[i]);
    text_at(draw, ui.fonts.small, {x, area.pos.y + ui.px(3)}, ui.colours.text_dim, kWords[i]);
    x -= ui.px(11);
    draw_answer(ui, {x, y}, kPoints[i]);
    x -= ui.px(16);
  }
}

}  // namespace

void draw_force_trace(const UiContext& ui, const OperatorScreen& screen, ImVec2 at, ImVec2 size) {
  const float most = screen.force_n.empty() ? 0.0f : *std::max_element(screen.force_n.begin(), screen.force_n.end());
  const double top = round_up(std::max({1.0, 1.15 * static_cast<double>(most), 1.05 * screen.force_limit_n}));
  const PlainPlot plot{
      plain_area(ui, at, size), {-screen.trace_s, 0.0, false, "s before now"}, {0.0, top, false, "Force felt, N"}};
  draw_axes(ui, plot);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (screen.force_limit_n > 0.0) {
    const float y = plot.at(0.0, screen.force_limit_n).y;
    draw_dashed_horizontal(draw, plot.area.min.x, plot.area.max.x, y, ui.px(5), ui.colours.warning, ui.px(1.2f));
    text_at(draw, ui.fonts.small, {plot.area.min.x + ui.px(6), y - 1.25f * ui.fonts.small->FontSize},
            ui.colours.warning, screen.limit_is_the_devices ? "limit of the device" : "limit of the protocol");
  }
  std::vector<ImVec2> line;
  for (std::size_t i = 0; i < screen.force_n.size() && screen.force_n.size() > 1; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(screen.force_n.size() - 1);
    line.push_back(plot.at(screen.trace_s * (share - 1.0), static_cast<double>(screen.force_n[i])));
  }
  draw.AddPolyline(line.data(), static_cast<int>(line.size()), colour(ui.palette.force_magnitude), 0, ui.px(1.5f));
}

void draw_staircase(const UiContext& ui, const OperatorScreen& screen, ImVec2 at, ImVec2 size) {
  double low = 1e9, high = 2.0;
  for (const StaircasePoint& point : screen.staircase) {
    low = std::min(low, static_cast<double>(point.segments));
    high = std::max(high, static_cast<double>(point.segments));
  }
  const std::size_t room = std::max<std::size_t>(40, screen.staircase.size() + 2);
  low = std::min(low, high);
  const bool decades = high > 10.0 * low;  // whole ones, so that their ends are named
  const double from = decades ? std::pow(10.0, std::floor(std::log10(low))) : 0.0;
  const double to = decades ? std::pow(10.0, std::ceil(std::log10(high))) : round_up(1.1 * high);
  const PlainPlot plot{plain_area(ui, at, size),
                       {0.0, static_cast<double>(room), false, "trial"},
                       {from, to, decades, "Segments, " + screen.condition}};
  draw_axes(ui, plot);
  draw_key(ui, plot.area);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  std::vector<ImVec2> places;
  for (const StaircasePoint& point : screen.staircase)
    places.push_back(plot.at(static_cast<double>(places.size() + 1), static_cast<double>(point.segments)));
  draw.AddPolyline(places.data(), static_cast<int>(places.size()), ui.colours.text_dim, 0, ui.px(1));
  for (std::size_t i = 0; i < places.size(); ++i) draw_answer(ui, places[i], screen.staircase[i]);
}

}  // namespace tangent
