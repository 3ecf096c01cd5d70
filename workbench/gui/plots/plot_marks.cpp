#include "workbench/gui/plots/plot_marks.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tangent {

namespace {

/// A pixel column shows its worst event, so that none is lost at any zoom.
void draw_events(const UiContext& ui, const PlotMarks& marks, const ChannelStore& store, const TimeAxis& axis,
                 const PlotArea& area, KeptBars& events) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (const ColumnBar& bar : events.update(store, *marks.event_channel, axis, area.width())) {
    const auto rank = static_cast<std::size_t>(bar.range.max);
    if (rank < 1 || rank > marks.event_inks.size()) continue;
    const float x = std::floor(area.min.x + bar.x), high = area.strip * (0.4f + 0.15f * static_cast<float>(rank));
    draw.AddRectFilled({x, area.bottom() - high}, {x + std::max(1.0f, ui.px(1.5f)), area.bottom()},
                       marks.event_inks[rank - 1]);
  }
}

}  // namespace

const std::string* draw_marks(const UiContext& ui, const PlotMarks& marks, const ChannelStore& store,
                              const TimeAxis& axis, const PlotArea& area, KeptBars& events) {
  if (marks.event_channel) draw_events(ui, marks, store, axis, area, events);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool inside = mouse.x >= area.min.x && mouse.x <= area.max.x && mouse.y >= area.min.y && mouse.y <= area.max.y;
  const std::string* pointed = nullptr;
  const auto x_of = [&](std::uint64_t tick) {
    return std::round(static_cast<float>(
        axis.x_at(static_cast<double>(tick), static_cast<double>(area.min.x), static_cast<double>(area.width()))));
  };
  float last_x = -1e9f;  // a dragged slider makes many marks: at most one every few pixels
  for (const TickMark& mark : marks.changes) {
    if (static_cast<double>(mark.tick) < axis.from() || static_cast<double>(mark.tick) > axis.to()) continue;
    const float x = x_of(mark.tick);
    if (inside && std::abs(mouse.x - x) <= ui.px(3)) pointed = &mark.text;
    if (x - last_x < ui.px(3)) continue;
    last_x = x;
    for (float y = area.min.y; y < area.max.y; y += ui.px(6))
      draw.AddLine({x, y}, {x, std::min(y + ui.px(3), area.max.y)}, mark.ink, ui.px(1));
    const float r = ui.px(3);
    draw.AddQuadFilled({x, area.min.y}, {x + r, area.min.y + r}, {x, area.min.y + 2 * r}, {x - r, area.min.y + r},
                       mark.ink);
  }
  for (const TickMark& mark : marks.flags) {
    if (static_cast<double>(mark.last_tick) < axis.from() || static_cast<double>(mark.tick) > axis.to()) continue;
    const float x0 = x_of(mark.tick), x1 = std::max(x0 + ui.px(2), x_of(mark.last_tick)), y = area.min.y;
    draw.AddRectFilled({x0, y}, {x1, y + ui.px(2.5f)}, mark.ink);
    draw.AddTriangleFilled({x0, y}, {x0 + ui.px(6), y}, {x0, y + ui.px(7)}, mark.ink);
    if (inside && mouse.y < y + ui.px(9) && mouse.x >= x0 - ui.px(3) &&
        mouse.x <= std::max(x1, x0 + ui.px(6)) + ui.px(1))
      pointed = &mark.text;
  }
  return pointed;
}

}  // namespace tangent
