// Settings of the map over the mesh: quantity, colours, progress, worst places. The colour bar is in the 3D view
// (map_bar.cpp).
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <charconv>
#include <cmath>

namespace tangent {

namespace {

double shown(const MapView& map, double value) { return value / unit_of(map.quantity).in_si; }

std::string unit_suffix(const MapView& map) {
  const std::string_view unit = unit_of(map.quantity).name;
  return unit.empty() ? "" : " " + std::string(unit);
}

void draw_choice(const UiContext& ui, MapView& map) {
  std::array<std::string_view, kMapQuantityCount + 1> names{"None"};
  for (std::size_t q = 0; q < kMapQuantityCount; ++q) names[q + 1] = info_of(static_cast<MapQuantity>(q)).label;
  int chosen = map.on ? static_cast<int>(map.quantity) + 1 : 0;
  if (choice_row(ui, "map/quantity", ImGui::GetContentRegionAvail().x, names, chosen)) {
    map.on = chosen > 0;
    if (map.on) map.set_quantity(static_cast<MapQuantity>(chosen - 1));
  }
  const std::string_view doc = info_of(map.quantity).doc;
  tooltip(ui, map.on ? doc
                     : "Colours the surface by a quantity measured at every place: how the solver, the finger and the "
                       "gains do there");
}

void draw_progress(const UiContext& ui, MapView& map) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float button = ui.px(64), width = ImGui::GetContentRegionAvail().x - button - ui.px(6),
              height = ImGui::GetFrameHeight();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float share = static_cast<float>(map.progress());
  draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.colours.field, ui.px(3));
  if (share > 0.0f)
    draw.AddRectFilled(at, {at.x + std::max(ui.px(4), share * width), at.y + height}, ui.colours.accent_soft, ui.px(3));
  std::string text = map.running()           ? printed("%3.0f %%", std::floor(100.0 * map.progress()))
                     : map.progress() >= 1.0 ? "complete"
                                             : "stopped";
  if (map.stale()) text += ", of earlier values";
  draw.AddText({at.x + ui.px(8), at.y + 0.5f * (height - ImGui::GetFontSize())},
               map.stale() ? ui.colours.warning : ui.colours.text_dim, text.c_str());
  ImGui::Dummy({width, height});
  ui.items.note_last("map/progress");
  tooltip(ui, "Computed in the background in random order, so that a part of it is already a fair sample");
  ImGui::SameLine(0, ui.px(6));
  if (map.running()) {
    if (text_button(ui, "map/cancel", "Cancel", "Stops and keeps what is computed")) map.cancel();
  } else if (text_button(ui, "map/again", "Again", "Computes it again with the current preset")) {
    map.compute_again();
  }
}

std::optional<double> parsed(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void draw_range(const UiContext& ui, MapView& map) {
  const double unit = unit_of(map.quantity).in_si;
  const float width = ImGui::GetContentRegionAvail().x;
  const float box = std::floor((width - ui.px(118)) * 0.5f);
  const auto typed_low = number_box(ui, "map/low", box, printed("%.4g", shown(map, map.low())));
  tooltip(ui, "Value of the first colour; or drag the lower half of the colour bar");
  ImGui::SameLine(0, ui.px(4));
  const auto typed_high = number_box(ui, "map/high", box, printed("%.4g", shown(map, map.high())));
  tooltip(ui, "Value of the last colour; or drag the upper half of the colour bar");
  if (const auto v = typed_low ? parsed(*typed_low) : std::nullopt) map.set_range(*v * unit, map.high());
  if (const auto v = typed_high ? parsed(*typed_high) : std::nullopt) map.set_range(map.low(), *v * unit);
  ImGui::SameLine(0, ui.px(4));
  bool automatic = map.automatic_range();
  if (toggle_button(ui, "map/auto", "Auto", automatic, "The range of all but 1 % of the values (0.5 to 99.5 %)")) {
    if (automatic)
      map.set_automatic_range();
    else
      map.set_range(map.low(), map.high());
  }
  if (info_of(map.quantity).about_zero) return;
  ImGui::SameLine(0, ui.px(4));
  bool logarithmic = map.logarithmic();
  if (toggle_button(ui, "map/log", "Log", logarithmic, "Equal steps of colour are equal factors"))
    map.set_logarithmic(logarithmic);
}

void draw_look(const UiContext& ui, MapView& map) {
  const float width = ImGui::GetContentRegionAvail().x;
  int colours = static_cast<int>(map.colours);
  if (info_of(map.quantity).about_zero) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("Blue and orange, white at 0");
    ImGui::SameLine(width - ui.px(112) + ui.px(8));
  } else {
    if (choice_row(ui, "map/colours", width - ui.px(116), colour_map_names(), colours))
      map.colours = static_cast<ColourMap>(colours);
    tooltip(ui,
            "Equal steps of colour look equally large, and lightness alone orders the values, so that every eye can "
            "read them");
    ImGui::SameLine(0, ui.px(4));
  }
  toggle_button(ui, "map/follow", "Follow preset", map.follow_changes,
                "Computes again when the preset or the mesh changes");
}

void draw_moves(const UiContext& ui, MapView& map) {
  const float width = ImGui::GetContentRegionAvail().x;
  const auto row = [&](const char* path, const char* label, double value, const char* unit, const char* doc) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(width - ui.px(92));
    const auto typed = number_box(ui, path, ui.px(66), short_number(value));
    tooltip(ui, doc);
    ImGui::SameLine(0, ui.px(4));
    ImGui::TextDisabled("%s", unit);
    return typed ? parsed(*typed) : std::nullopt;
  };
  if (const auto v = row("map/directions", "Directions", map.options.directions, "",
                         "Directions of motion tried from every place, 1 to 32, besides one straight in"))
    map.options.directions = static_cast<unsigned>(std::clamp(*v, 1.0, 32.0));
  if (const auto v = row("map/move", "Move per tick", map.options.move_m * 1e3, "mm",
                         "How far the finger moves: 0.1 mm is 0.1 m/s at 1 kHz"))
    map.options.move_m = std::clamp(*v, 1e-4, 10.0) * 1e-3;
  if (const auto v =
          row("map/press", "Pressed in", map.options.press_m * 1e3, "mm", "How deep the finger rests at every place"))
    map.options.press_m = std::clamp(*v, 0.0, 20.0) * 1e-3;
}

void draw_figures(const UiContext& ui, const MapView& map) {
  const MapStatistics& s = map.statistics();
  const char* unit = unit_of(map.quantity).name.data();
  const auto value = [&](double v) { return printed("%.4g", shown(map, v)); };
  fact(ui, "Mean", s.values > 0 ? value(s.mean) : "-", unit);
  fact(ui, "Smallest / largest", s.values > 0 ? value(s.min) + " / " + value(s.max) : "-", unit);
  tooltip(ui, "Of all places computed so far");
  if (!info_of(map.quantity).low_is_worse) fact(ui, "99th percentile", s.values > 0 ? value(s.p99) : "-", unit);
  if (const auto limit = map.limit()) {
    const std::string label = printed("%s %.3g%s", info_of(map.quantity).low_is_worse ? "Below" : "Above",
                                      shown(map, *limit), unit_suffix(map).c_str());
    fact(ui, label.c_str(), printed("%.2f", 100.0 * s.share_beyond_limit), "%",
         s.share_beyond_limit > 0.0 ? std::optional(ui.colours.warning) : std::nullopt);
    tooltip(ui, map.quantity == MapQuantity::touch_radius ? "Share of the places at which the finger touches two walls"
                : map.quantity == MapQuantity::facet_angle
                    ? "Share of the places whose facet is felt under the condition of Smoothness as felt"
                    : "Share of the places at which the paper's iteration does not converge");
  }
  const auto all = static_cast<double>(std::max<std::size_t>(1, s.values + s.none));
  if (group_of(map.quantity) == MapGroup::solve) {
    fact(ui, "Finger can't rest", printed("%.2f", 100.0 * static_cast<double>(s.none) / all), "%");
    tooltip(ui,
            "Share of the places without a value: the contact there is unstable, as in grooves tighter than the "
            "finger, or no move converged");
  }
}

void draw_worst(const UiContext& ui, AppModel& model) {
  const MapView& map = model.map();
  if (map.worst().empty()) return;
  ImGui::TextDisabled("Worst places");
  tooltip(ui, "A click goes there and solves a tick there. W: from one to the next");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.px(18);
  for (std::size_t i = 0; i < map.worst().size(); ++i) {
    const MapPlace& place = map.worst()[i];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton(printed("##worst%zu", i).c_str(), {width, height})) {
      model.view().look_at_place(place.point_world, place.normal, place.triangle);
      model.solve_here(place.triangle, place.u, place.v);
    }
    ui.items.note_last(printed("map/worst/%zu", i));
    tooltip(ui,
            "Turns the view there, picks the triangle and solves a tick there, in the worst of the map's directions");
    const bool picked = model.view().picked_triangle == place.triangle;
    if (ImGui::IsItemHovered() || picked)
      draw.AddRectFilled(at, {at.x + width, at.y + height}, picked ? ui.colours.accent_fill : ui.colours.accent_soft,
                         ui.px(2));
    const auto paint = map.paint();
    if (paint)
      draw.AddRectFilled({at.x + ui.px(2), at.y + ui.px(3)}, {at.x + ui.px(14), at.y + height - ui.px(3)},
                         packed(map_colour(*paint, place.value)), ui.px(2));
    ImFont* number = ui.fonts.small_number;
    draw.AddText(number, number->FontSize, {at.x + ui.px(20), at.y + ui.px(3)}, ui.colours.text,
                 (printed("%.4g", shown(map, place.value)) + unit_suffix(map)).c_str());
    const std::string where = printed("triangle %u", place.triangle);
    const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, where.c_str()).x;
    draw.AddText(number, number->FontSize, {at.x + width - w - ui.px(4), at.y + ui.px(3)}, ui.colours.text_dim,
                 where.c_str());
  }
}

}  // namespace

void draw_map_panel(const UiContext& ui, AppModel& model, MapPanel& state) {
  if (!section(ui, "Map", state.open)) return;
  MapView& map = model.map();
  draw_choice(ui, map);
  if (!map.on) {
    ImGui::Dummy({1, ui.px(2)});
    return;
  }
  draw_progress(ui, map);
  draw_range(ui, map);
  draw_look(ui, map);
  draw_figures(ui, map);
  if (group_of(map.quantity) == MapGroup::solve) draw_moves(ui, map);
  draw_worst(ui, model);
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
