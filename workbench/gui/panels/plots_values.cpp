// Table of the curves' values: samples at the time cursor, at A and at B, their difference, and statistics of the
// samples in view.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {

namespace {

struct Column {
  const char* title;
  bool wanted;  ///< columns without values are hidden
};
constexpr std::size_t kColumns = 9;

std::array<Column, kColumns> columns_for(const PlotLink& link) {
  return {{{.title = "now", .wanted = true},
           {.title = "ghost", .wanted = link.ghost != nullptr},
           {.title = "A", .wanted = link.a.has_value()},
           {.title = "B", .wanted = link.b.has_value()},
           {.title = "B\u2212A", .wanted = link.a && link.b},
           {.title = "min", .wanted = true},
           {.title = "max", .wanted = true},
           {.title = "mean", .wanted = true},
           {.title = "RMS", .wanted = true}}};
}

/// Values by column.
std::array<double, kColumns> values_of(const TimeModel& time, const PlotLink& link, const PlotSeries& curve,
                                       std::uint64_t from, std::uint64_t to) {
  const ChannelStore& store = curve.store_in(time.store());
  const ChannelStore* again = curve.ghost_in(link.ghost);
  const std::size_t channel = curve.channel;
  const double nan = std::nan("");
  const auto at = [&](const std::optional<std::uint64_t>& tick) {
    return tick ? static_cast<double>(store.value(channel, *tick)) : nan;
  };
  const ServoRecord* record = time.tick().record();
  std::optional<std::uint64_t> now;
  if (record != nullptr) now = record->tick.tick;
  const MinMax range = store.min_max(channel, from, to);
  const SampleSums sums = store.sums(channel, from, to);
  const double ghost = again != nullptr && now ? static_cast<double>(again->value(curve.ghost.value_or(0), *now)) : nan;
  std::array<double, kColumns> out{at(now),
                                   ghost,
                                   at(link.a),
                                   at(link.b),
                                   at(link.b) - at(link.a),
                                   range.empty() ? nan : static_cast<double>(range.min),
                                   range.empty() ? nan : static_cast<double>(range.max),
                                   sums.mean(),
                                   sums.rms()};
  for (double& v : out) v *= curve.scale;
  return out;
}

/// Those of the plots, each once.
std::vector<const PlotSeries*> shown_curves(const PlotsPanel& state) {
  std::vector<const PlotSeries*> out;
  for (const PlotView& plot : state.plots)
    for (const PlotSeries& series : plot.spec().series)
      if (std::none_of(out.begin(), out.end(), [&](const PlotSeries* s) { return s->key == series.key; }))
        out.push_back(&series);
  return out;
}

}  // namespace

void draw_values_table(const UiContext& ui, TimeModel& time, PlotsPanel& state, const Rect& rect) {
  ImGui::SetCursorScreenPos({rect.x, rect.y});
  ImGui::BeginChild("values", {rect.w - ui.px(8), rect.h}, false, ImGuiWindowFlags_NoNav);
  const auto [from, to] = ticks_in_view(time);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* font = ui.fonts.small_number;
  ImFont* text = ui.fonts.small;
  const PlotLink& link = state.link;
  std::array<Column, kColumns> columns = columns_for(link);
  std::array<std::size_t, kColumns> place{};
  std::size_t shown = 0;
  // As many of the columns as have room for their numbers.
  const float name_width = ui.px(150), room = rect.w - ui.px(26) - name_width, least = text_width(font, "-1.23e-06 ");
  for (std::size_t c = 0; c < kColumns; ++c) {
    columns[c].wanted = columns[c].wanted && static_cast<float>(shown + 1) * least <= room;
    place[c] = columns[c].wanted ? shown++ : shown;
  }
  const float column = std::min(ui.px(76), room / static_cast<float>(std::max<std::size_t>(1, shown)));
  ImVec2 at = ImGui::GetCursorScreenPos();
  const auto right = [&](ImFont* f, std::size_t c, ImU32 ink, const char* value) {
    if (!columns[c].wanted) return;
    draw.AddText(f, f->FontSize,
                 {at.x + name_width + static_cast<float>(place[c] + 1) * column -
                      f->CalcTextSizeA(f->FontSize, 1e9f, 0.0f, value).x,
                  at.y},
                 ink, value);
  };
  const std::string heading = printed("%llu ticks in view", static_cast<unsigned long long>(to - from));
  draw.AddText(text, text->FontSize, at, ui.colours.text_dim, heading.c_str());
  for (std::size_t c = 0; c < kColumns; ++c) right(text, c, ui.colours.text_dim, columns[c].title);
  at.y += text->FontSize + ui.px(5);
  for (const PlotSeries* of_plot : shown_curves(state)) {
    const PlotSeries& curve = *of_plot;
    const ImU32 ink = packed(ui.palette.*curve.colour);
    draw.AddRectFilled({at.x, at.y + ui.px(2)}, {at.x + ui.px(8), at.y + ui.px(10)}, ink, ui.px(2));
    draw.PushClipRect(at, {at.x + name_width, at.y + 2.0f * text->FontSize}, true);
    draw.AddText(text, text->FontSize, {at.x + ui.px(13), at.y}, ui.colours.text, with_unit(curve).c_str());
    draw.PopClipRect();
    ImGui::SetCursorScreenPos(at);
    ImGui::InvisibleButton(curve.key.c_str(), {name_width, text->FontSize + ui.px(3)});
    drag_channels(curve.key, curve.full_name);
    ui.items.note_last("plots/value/" + curve.key);
    tooltip(ui, with_unit(curve) + ". Drag: onto a plot");
    const auto values = values_of(time, link, curve, from, to);
    for (std::size_t c = 0; c < values.size(); ++c)
      right(font, c, ui.colours.text, std::isnan(values[c]) ? "\u2013" : printed("%.3g", values[c]).c_str());
    at.y += text->FontSize + ui.px(4);
  }
  ImGui::SetCursorScreenPos(at);
  ImGui::Dummy({1.0f, 1.0f});
  ImGui::EndChild();
  ui.items.note_last("plots/values_table");
}

}  // namespace tangent
