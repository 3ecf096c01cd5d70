#include "workbench/gui/plots/plot_view.h"

#include "workbench/gui/plots/curve_drawing.h"
#include "workbench/gui/plots/tick_locator.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cstdio>

namespace tangent {

namespace {

/// Label with a cursor's time, below the axis.
struct CursorLabel {
  float left = 0.0f, right = 0.0f;
  char text[48] = "";
};
CursorLabel cursor_label(const UiContext& ui, const TimeAxis& axis, const PlotLink& link, const PlotArea& area,
                         double tick) {
  CursorLabel label;
  std::snprintf(label.text, sizeof label.text, "%.3f s", tick * link.tick_period_s);
  const float x = std::round(
      static_cast<float>(axis.x_at(tick, static_cast<double>(area.min.x), static_cast<double>(area.width()))));
  const float w = text_width(ui.fonts.small_number, label.text) + ui.px(8);
  label.left = std::clamp(x - 0.5f * w, area.min.x, std::max(area.min.x, area.max.x - w));
  label.right = label.left + w;
  return label;
}

MinMax scaled(MinMax range, double scale) {
  if (range.empty()) return range;
  return {static_cast<float>(static_cast<double>(range.min) * scale),
          static_cast<float>(static_cast<double>(range.max) * scale)};
}

bool in_view(const TimeAxis& axis, double tick) { return tick >= axis.from() && tick <= axis.to(); }

}  // namespace

ImU32 ghost_ink(const UiContext& ui, const PlotSeries& series) {
  return packed(mix(ui.palette.*series.colour, ui.palette.text, 0.75f));
}

void drag_channels(const std::string& keys, const std::string& shown) {
  if (!ImGui::BeginDragDropSource(ImGuiDragDropFlags_SourceAllowNullID)) return;
  ImGui::SetDragDropPayload(kChannelPayload, keys.data(), keys.size());
  ImGui::TextUnformatted(shown.c_str());
  ImGui::EndDragDropSource();
}

void PlotView::draw(const UiContext& ui, const ChannelStore& store, TimeAxis& axis, PlotLink& link, ImVec2 pos,
                    ImVec2 size, bool time_labels, double reference) {
  PlotArea area;
  area.pos = pos;
  area.size = size;
  area.gutter = ui.px(46);
  area.header = ui.px(18);
  area.min = {pos.x + area.gutter, pos.y + area.header};
  // Events have their own strip: over the curves they would cover what is near zero, such as a cured failure's ghost.
  const float room = size.y - area.header - (time_labels ? ui.px(18) : ui.px(5));
  area.strip = link.marks.event_channel ? std::min(ui.px(kEventStrip), 0.2f * room) : 0.0f;
  area.max = {pos.x + size.x - ui.px(8), pos.y + size.y - (time_labels ? ui.px(18) : ui.px(5)) - area.strip};
  if (area.width() < ui.px(24) || area.height() < ui.px(12)) return;

  ImGui::PushID(spec_.id.c_str());
  interact(ui, axis, link, area);
  interact_values(ui, area);
  if (time_labels) interact_time_labels(ui, axis, area);
  fit(store, axis, link, reference);
  draw_grid(ui, axis, link, area, time_labels);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.PushClipRect(area.min, area.max, true);
  if (std::isfinite(reference)) {
    const double share = values_.share(reference * spec_.scale, spec_.log);
    const float y = std::round(area.max.y - static_cast<float>(share) * area.height());
    draw_dashed_horizontal(draw, area.min.x, area.max.x, y, ui.px(5), ui.colours.text_faint, ui.px(1));
  }
  if (nothing_in_view_) {
    ImFont* font = ui.fonts.small;
    const std::string text = fitted(font, spec_.nothing, area.width() - ui.px(4));
    text_at(draw, font,
            {area.min.x + 0.5f * (area.width() - text_width(font, text.c_str())),
             area.min.y + 0.5f * (area.height() - font->FontSize)},
            ui.colours.text_faint, text.c_str());
  }
  draw_series(ui, store, axis, link, area);
  draw.PopClipRect();
  draw.PushClipRect(area.min, {area.max.x, area.bottom()}, true);
  const std::string* pointed = draw_marks(ui, link.marks, store, axis, area, events_);
  draw.PopClipRect();
  draw_cursors(ui, axis, link, area, time_labels);
  draw_header(ui, store, link, area);
  if (pointed != nullptr && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) ImGui::SetTooltip("%s", pointed->c_str());
  ImGui::PopID();
}

void PlotView::fit(const ChannelStore& store, const TimeAxis& axis, const PlotLink& link, double reference) {
  MinMax visible;
  const auto from = static_cast<std::uint64_t>(std::max(0.0, std::floor(axis.from())));
  const auto to = static_cast<std::uint64_t>(std::max(0.0, std::ceil(axis.to())));
  for (const PlotSeries& series : spec_.series) {
    if (!series.visible) continue;
    visible.include(scaled(series.store_in(store).min_max(series.channel, from, to), series.scale));
    if (const ChannelStore* ghost = series.ghost_in(link.ghost))
      visible.include(scaled(ghost->min_max(series.ghost.value_or(0), from, to), series.scale));
  }
  nothing_in_view_ = visible.empty();
  if (spec_.series.empty()) values_ = {};  // what was there before leaves no trace
  if (visible.empty()) return;
  // Room around the reference line and around steps at the axis's ends.
  if (std::isfinite(reference)) visible.include(static_cast<float>(1.2 * reference * spec_.scale));
  if (spec_.counts) visible.max += 0.25f;
  if (spec_.log)
    values_.fit_log(visible, spec_.floor);
  else
    values_.fit_linear(visible, spec_.with_zero);
}

void PlotView::draw_grid(const UiContext& ui, const TimeAxis& axis, const PlotLink& link, const PlotArea& area,
                         bool time_labels) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(area.min, {area.max.x, area.bottom()}, ui.colours.plot);
  ImFont* font = ui.fonts.small_number;
  const float half = 0.5f * font->FontSize;
  for (const AxisTick& tick : value_ticks({values_.low(), values_.high(), spec_.log, spec_.counts,
                                           static_cast<double>(area.height() / font->FontSize)})) {
    const double share = values_.share(tick.value, spec_.log);
    const float y = std::round(area.max.y - static_cast<float>(share) * area.height());
    if (y > area.min.y && y < area.max.y) {
      draw.AddLine({area.min.x, y}, {area.max.x, y}, tick.major ? ui.colours.grid : ui.colours.grid_minor);
    }
    if (!tick.major) continue;
    // Labels at the ends move inwards, so that they don't overlap the neighbouring plots; those of a low plot stay at
    // their ticks, because they would meet one another.
    const bool low = area.height() < 2.2f * font->FontSize;
    const float label_y =
        std::clamp(y - half, area.min.y - (low ? 1.0f : 0.35f) * half, area.max.y - (low ? 1.0f : 1.75f) * half);
    text_at(draw, font, {area.min.x - ui.px(5) - text_width(font, tick.label.c_str()), label_y}, ui.colours.text_dim,
            tick.label.c_str());
  }
  const double left = static_cast<double>(area.min.x), width = static_cast<double>(area.width());
  const int columns = std::max(1, static_cast<int>(area.width() / (5.5f * font->FontSize)));
  const double period = link.tick_period_s;
  // Labels partly covered by a cursor's label are left out.
  const auto covered = [&](float from, float to) {
    const auto by = [&](double cursor) {
      if (!in_view(axis, cursor)) return false;
      const CursorLabel card = cursor_label(ui, axis, link, area, cursor);
      return from < card.right + ui.px(3) && to > card.left - ui.px(3);
    };
    return (link.cursor && by(static_cast<double>(*link.cursor))) || (link.hover && by(*link.hover));
  };
  for (const AxisTick& tick : linear_ticks(axis.from() * period, axis.to() * period, columns)) {
    const float x = std::round(static_cast<float>(axis.x_at(tick.value / period, left, width)));
    if (x <= area.min.x || x >= area.max.x) continue;
    draw.AddLine({x, area.min.y}, {x, area.max.y}, tick.major ? ui.colours.grid : ui.colours.grid_minor);
    if (!time_labels || !tick.major || tick.value < 0.0) continue;
    const float w = text_width(font, tick.label.c_str());
    if (x + 0.5f * w > area.max.x - ui.px(14) || covered(x - 0.5f * w, x + 0.5f * w)) continue;
    text_at(draw, font, {x - 0.5f * w, area.bottom() + ui.px(2)}, ui.colours.text_dim, tick.label.c_str());
  }
  if (time_labels) {
    const float unit = area.max.x - text_width(font, "s");
    if (!covered(unit, area.max.x)) text_at(draw, font, {unit, area.bottom() + ui.px(2)}, ui.colours.text_dim, "s");
  }
}

PlotView::ToPixel PlotView::to_pixel(const PlotArea& area, double scale) const {
  // Multiplication instead of division: there are tens of thousands of bars per frame.
  const double span = values_.high() - values_.low();
  return {&values_, area.max.y, area.height(), scale, scale / span, values_.low() / span, spec_.log};
}

float PlotView::ToPixel::operator()(float value) const {
  const double v = static_cast<double>(value);
  const double share = log ? values->share(v * scale, true) : v * gain - offset;
  return lowest - static_cast<float>(std::clamp(share, -1.0, 2.0)) * height;
}

void PlotView::draw_ghost(const UiContext& ui, Curve recorded, Curve ghost, const TimeAxis& axis, const PlotArea& area,
                          const PlotSeries& series) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const CurveArea where{area.min, area.max};
  const ToPixel to_y = to_pixel(area, series.scale);
  const auto same = [&](float a, float b) { return std::abs(to_y(a) - to_y(b)) < ui.px(0.9f); };
  if (axis.span() / static_cast<double>(area.width()) >= kTicksPerColumnForBars) {
    const auto& below = recorded.kept.update(recorded.store, recorded.channel, axis, area.width());
    const auto& above = ghost.kept.update(ghost.store, ghost.channel, axis, area.width());
    bars_.clear();
    for (std::size_t i = 0, k = 0; i < above.size(); ++i) {
      while (k < below.size() && below[k].x < above[i].x - 0.25f) ++k;
      const bool paired = k < below.size() && below[k].x < above[i].x + 0.25f;
      if (!paired || !same(below[k].range.min, above[i].range.min) || !same(below[k].range.max, above[i].range.max))
        bars_.push_back(above[i]);
    }
    return draw_bars(draw, where, bars_, to_y, ghost_ink(ui, series), ui.px(1.0f));
  }
  sample_points(ghost.store, ghost.channel, axis, area.width(), points_);
  sample_points(recorded.store, recorded.channel, axis, area.width(), below_);
  std::vector<bool> differs(points_.size(), true);
  for (std::size_t i = 0, k = 0; i < points_.size(); ++i) {
    while (k < below_.size() && below_[k].x < points_[i].x - 0.01f) ++k;
    differs[i] = k >= below_.size() || below_[k].x > points_[i].x + 0.01f || !same(below_[k].value, points_[i].value);
  }
  std::vector<SamplePoint> shown;
  bool gap = true;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    // With a neighbour on each side, so that the lines to them are drawn.
    const bool near = differs[i] || (i > 0 && differs[i - 1]) || (i + 1 < points_.size() && differs[i + 1]);
    if (near) shown.push_back({points_[i].x, points_[i].value, gap || points_[i].after_gap});
    gap = !near;
  }
  const bool dots = static_cast<double>(area.width()) / axis.span() > static_cast<double>(ui.px(7));
  draw_samples(draw, where, shown, line_, to_y, ghost_ink(ui, series), ui.px(1.0f), series.steps,
               dots ? ui.px(2.2f) : 0.0f);
}

void PlotView::draw_curve(const UiContext& ui, Curve curve, const TimeAxis& axis, const PlotArea& area,
                          const PlotSeries& series, ImU32 ink) {
  constexpr float thickness = 1.5f;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const CurveArea where{area.min, area.max};
  const bool bars = axis.span() / static_cast<double>(area.width()) >= kTicksPerColumnForBars;
  const auto draw_with = [&](auto to_y) {
    if (bars)
      return draw_bars(draw, where, curve.kept.update(curve.store, curve.channel, axis, area.width()), to_y, ink,
                       ui.px(thickness));
    sample_points(curve.store, curve.channel, axis, area.width(), points_);
    const bool dots = static_cast<double>(area.width()) / axis.span() > static_cast<double>(ui.px(7));
    draw_samples(draw, where, points_, line_, to_y, ink, ui.px(thickness), series.steps, dots ? ui.px(2.2f) : 0.0f);
  };
  draw_with(to_pixel(area, series.scale));
}

void PlotView::draw_series(const UiContext& ui, const ChannelStore& store, const TimeAxis& axis, const PlotLink& link,
                           const PlotArea& area) {
  curves_.resize(spec_.series.size());
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const PlotSeries& series = spec_.series[i];
    if (!series.visible) continue;
    // Beside its ghost the recorded curve steps back.
    const Rgba ink = ui.palette.*series.colour;
    const bool with_ghost = series.ghost_in(link.ghost) != nullptr;
    draw_curve(ui, {series.store_in(store), series.channel, curves_[i].recorded}, axis, area, series,
               packed(with_alpha(ink, with_ghost ? 0.55f : 1.0f)));
  }
  // Ghosts over all of them, where they differ.
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const PlotSeries& series = spec_.series[i];
    const ChannelStore* ghost = series.ghost_in(link.ghost);
    if (!series.visible || ghost == nullptr) continue;
    draw_ghost(ui, {series.store_in(store), series.channel, curves_[i].recorded},
               {*ghost, series.ghost.value_or(0), curves_[i].ghost}, axis, area, series);
  }
}

void PlotView::draw_cursors(const UiContext& ui, const TimeAxis& axis, const PlotLink& link, const PlotArea& area,
                            bool time_labels) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const double left = static_cast<double>(area.min.x), width = static_cast<double>(area.width());
  const auto line_at = [&](double tick, ImU32 ink, bool label) {
    if (!in_view(axis, tick)) return;
    const float x = std::round(static_cast<float>(axis.x_at(tick, left, width)));
    draw.AddLine({x, area.min.y}, {x, area.max.y}, ink, ui.px(1));
    if (!label || !time_labels) return;
    const CursorLabel card = cursor_label(ui, axis, link, area, tick);
    draw.AddRectFilled({card.left, area.bottom() + ui.px(1)}, {card.right, area.bottom() + ui.px(17)},
                       ui.colours.panel_header, ui.px(2));
    text_at(draw, ui.fonts.small_number, {card.left + ui.px(4), area.bottom() + ui.px(2)}, ui.colours.text, card.text);
  };
  if (box_from_) {
    const float x0 = static_cast<float>(axis.x_at(*box_from_, left, width));
    const float x1 = std::clamp(ImGui::GetIO().MousePos.x, area.min.x, area.max.x);
    const float y = std::clamp(ImGui::GetIO().MousePos.y, area.min.y, area.max.y);
    const bool high = std::abs(y - box_y_) > ui.px(kHighBox);
    draw.AddRectFilled({std::min(x0, x1), high ? std::min(y, box_y_) : area.min.y},
                       {std::max(x0, x1), high ? std::max(y, box_y_) : area.max.y}, ui.colours.accent_soft);
  }
  const auto lettered = [&](const std::optional<std::uint64_t>& tick, const char* letter) {
    if (!tick || !in_view(axis, static_cast<double>(*tick))) return;
    const float x = std::round(static_cast<float>(axis.x_at(static_cast<double>(*tick), left, width)));
    draw.AddLine({x, area.min.y}, {x, area.max.y}, ui.colours.text, ui.px(1));
    const float w = text_width(ui.fonts.small, letter) + ui.px(6);
    draw.AddRectFilled({x, area.max.y - ui.px(15)}, {x + w, area.max.y}, ui.colours.text, ui.px(2));
    text_at(draw, ui.fonts.small, {x + ui.px(3), area.max.y - ui.px(14)}, ui.colours.plot, letter);
  };
  lettered(link.a, "A");
  lettered(link.b, "B");
  if (link.cursor) line_at(static_cast<double>(*link.cursor), ui.colours.accent, true);
  if (link.hover) line_at(*link.hover, ui.colours.text_faint, true);
}

void PlotView::touch_legend_entry(const UiContext& ui, PlotSeries& series, PlotLink& link, ImVec2 size) {
  ImGui::PushID(series.name.c_str());
  if (ImGui::InvisibleButton("toggle", size)) series.visible = !series.visible;
  if (!series.key.empty()) drag_channels(series.key, series.full_name);
  ui.items.note_last("plots/" + spec_.id + "/" + series.name);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s%s%s%s\nClick: hide or show. Drag: onto another plot too. Right-click: remove",
                      series.full_name.c_str(), series.unit.empty() ? "" : (", " + series.unit).c_str(),
                      series.doc[0] != '\0' ? ". " : "", series.doc);
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) link.removed = PlotLink::OnPlot{spec_.id, series.key};
  }
  ImGui::PopID();
}

void PlotView::draw_header(const UiContext& ui, const ChannelStore& store, PlotLink& link, const PlotArea& area) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float y = area.pos.y + ui.px(2);
  const float right = area.max.x;
  float x = area.min.x;
  text_at(draw, ui.fonts.small, {x, y}, ui.colours.text, spec_.title.c_str());
  if (!spec_.title.empty()) x += text_width(ui.fonts.small, spec_.title.c_str()) + ui.px(5);
  text_at(draw, ui.fonts.small, {x, y}, ui.colours.text_dim, spec_.unit.c_str());
  x += text_width(ui.fonts.small, spec_.unit.c_str()) + ui.px(10);

  std::optional<std::uint64_t> tick;
  if (link.hover && *link.hover >= 0.0)
    tick = static_cast<std::uint64_t>(*link.hover + 0.5);
  else if (link.cursor)
    tick = link.cursor;
  else if (!store.empty())
    tick = store.end_tick() - 1;

  const bool only_one = spec_.series.size() == 1 && !spec_.title.empty();  // the title says it
  const float box = ui.px(9), value_width = 9.0f * text_width(ui.fonts.small_number, "0");
  const auto name_of = [&](const PlotSeries& series) {
    if (only_one) return std::string();
    return spec_.unit.empty() && !series.unit.empty() ? series.name + " " + series.unit : series.name;
  };
  const auto width_of = [&](const std::string& name) {
    return box + ui.px(7) + text_width(ui.fonts.small, name.c_str());
  };
  // Where there is no room for all of them with their values, none has one.
  float whole = x;
  for (const PlotSeries& series : spec_.series) whole += width_of(name_of(series)) + value_width + ui.px(6);
  const bool with_value = whole <= right;
  for (PlotSeries& series : spec_.series) {
    const float value =
        tick ? series.store_in(store).value(series.channel, *tick) : std::numeric_limits<float>::quiet_NaN();
    char text[32] = "";
    if (!std::isnan(value)) std::snprintf(text, sizeof text, series.format, static_cast<double>(value) * series.scale);
    const std::string name = name_of(series);
    // Reserves the value's width while it is blank, so that nothing moves.
    const float width = width_of(name) + (with_value ? value_width : 0.0f);
    if (x + width > right) break;
    ImGui::SetCursorScreenPos({x, area.pos.y});
    touch_legend_entry(ui, series, link, {width, area.header});
    const ImU32 ink = packed(ui.palette.*series.colour);
    const float middle = y + 0.5f * ui.fonts.small->FontSize;
    const ImVec2 box_min{x, middle - 0.5f * box + ui.px(1)}, box_max{x + box, middle + 0.5f * box + ui.px(1)};
    if (series.visible)
      draw.AddRectFilled(box_min, box_max, ink, ui.px(2));
    else
      draw.AddRect(box_min, box_max, ink, ui.px(2));
    float at = x + box + ui.px(4);
    text_at(draw, ui.fonts.small, {at, y}, series.visible ? ui.colours.text : ui.colours.text_faint, name.c_str());
    at += text_width(ui.fonts.small, name.c_str()) + ui.px(3);
    if (with_value && text[0] != '\0') text_at(draw, ui.fonts.small_number, {at, y}, ui.colours.text, text);
    x += width + ui.px(6);
  }
}

}  // namespace tangent
