// The map's vertical colour bar in the 3D view, with the histogram beside it. Dragging its upper half moves the upper
// end of the range, its lower half the lower end; a double click sets the range automatically.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/render/quantity_text.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr float kBarWidth = 14.0f, kHistogramWidth = 44.0f, kPad = 8.0f;
constexpr float kBeyond = 14.0f;  ///< for the mark of a limit that is not on the bar

/// Values to label on the bar, in shown units: the ends, and round values between.
std::vector<double> bar_labels(const MapPaint& paint, double unit, double most) {
  const double low = paint.low / unit, high = paint.high / unit;
  std::vector<double> round;
  const double decades = paint.logarithmic ? std::log10(high / low) : 0.0;
  if (decades > 1.2) {
    const double every = std::max(1.0, std::ceil(decades / most));
    for (double power = std::floor(std::log10(low)); power <= std::log10(high); power += every) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor == 1.0 || decades < 0.4 * most) round.push_back(factor * std::pow(10.0, power));
      }
    }
  } else {
    const double step = round_number_below((high - low) / most * 2.0);
    for (double value = std::ceil(low / step) * step; value < high; value += step)
      round.push_back(std::abs(value) < 1e-9 * step ? 0.0 : value);
  }
  std::vector<double> out{low, high};
  // A round value too close to an end would overlap its label.
  for (const double value : round) {
    const double share = map_share(paint, value * unit);
    if (share > 0.7 / most && share < 1.0 - 0.7 / most) out.push_back(value);
  }
  std::sort(out.begin(), out.end());
  return out;
}

void drag_range(const UiContext& ui, MapView& map, const MapPaint& paint, const Rect& bar) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) return map.set_automatic_range();
  if (!ImGui::IsItemActive() || io.MouseDelta.y == 0.0f || !ImGui::IsMouseDragging(ImGuiMouseButton_Left, ui.px(2)))
    return;
  const bool upper = io.MouseClickedPos[0].y < bar.y + 0.5f * bar.h;
  // The value under the pointer follows it, so the end moves the other way.
  const double by = static_cast<double>(io.MouseDelta.y / bar.h);
  const double at = upper ? 1.0 / std::max(0.1, 1.0 - by) : 1.0 - 1.0 / std::max(0.1, 1.0 + by);
  if (info_of(map.quantity).about_zero) {
    const double high = paint.high * (upper ? at : 1.0 - at);
    return map.set_range(-high, high);
  }
  if (upper)
    map.set_range(map.low(), map_value_at(paint, at));
  else
    map.set_range(map_value_at(paint, at), map.high());
}

/// A labelled line across histogram and bar; if the limit is outside the range, an arrow beyond that end.
void draw_limit(const UiContext& ui, const Rect& bar, double share, double shown) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* number = ui.fonts.small_number;
  float y = bar.bottom() - bar.h * static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (share >= 0.0 && share <= 1.0) {
    draw.AddLine({bar.x - ui.px(kHistogramWidth - 4.0f), y}, {bar.right() + ui.px(4), y}, ui.colours.warning,
                 ui.px(1.5f));
    if (y < bar.y + number->FontSize || y > bar.bottom() - number->FontSize) y = 0.0f;  // would overlap an end's label
  } else {
    const float r = ui.px(4), x = bar.x + 0.5f * bar.w, out = share < 0.0 ? 1.0f : -1.0f;
    y += out * ui.px(kBeyond);
    draw.AddTriangleFilled({x - r, y - out * r}, {x + r, y - out * r}, {x, y + out * r}, ui.colours.warning);
  }
  if (y > 0.0f)
    draw.AddText(number, number->FontSize, {bar.right() + ui.px(7), y - 0.5f * number->FontSize}, ui.colours.warning,
                 printed("%.4g", shown).c_str());
  ui.items.note("view/map_bar/limit", {bar.x, y - 1.0f}, {bar.right(), y + 1.0f});
}

void draw_colours(const UiContext& ui, const MapPaint& paint, const Rect& bar) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto& table = colour_table(paint.colours);
  constexpr int kColourSteps = 64;
  for (int i = 0; i < kColourSteps; ++i) {
    const auto at = [&](int k) {
      const int index = k * (static_cast<int>(table.size()) - 1) / kColourSteps;
      return packed(
          table[static_cast<std::size_t>(paint.reversed ? static_cast<int>(table.size()) - 1 - index : index)]);
    };
    const float y0 = bar.bottom() - bar.h * static_cast<float>(i) / kColourSteps,
                y1 = bar.bottom() - bar.h * static_cast<float>(i + 1) / kColourSteps;
    draw.AddRectFilledMultiColor({bar.x, y1}, {bar.right(), y0}, at(i + 1), at(i + 1), at(i), at(i));
  }
  draw.AddRect({bar.x - 1, bar.y - 1}, {bar.right() + 1, bar.bottom() + 1}, ui.colours.border);
}

void draw_bins(const UiContext& ui, const MapStatistics& s, const Rect& bar) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < MapStatistics::kBins && s.fullest > 0; ++i) {
    if (s.bins[i] == 0) continue;
    // A non-empty bin is at least one pixel long: the few bad places are what matters.
    const float length =
        std::max(1.0f, ui.px(kHistogramWidth - 6.0f) * static_cast<float>(s.bins[i]) / static_cast<float>(s.fullest));
    const float y1 = bar.bottom() - bar.h * static_cast<float>(i + 1) / MapStatistics::kBins,
                y0 = bar.bottom() - bar.h * static_cast<float>(i) / MapStatistics::kBins;
    draw.AddRectFilled({bar.x - ui.px(3) - length, y1}, {bar.x - ui.px(3), std::max(y0 - 0.5f, y1 + 1.0f)},
                       ui.colours.text_dim);
  }
}

/// `unit_si`: the shown unit in SI; `limit_share`: position of the limit's label.
void draw_numbers(const UiContext& ui, const MapPaint& paint, double unit_si, const Rect& bar,
                  std::optional<double> limit_share) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* number = ui.fonts.small_number;
  const float line = number->FontSize;
  for (const double value : bar_labels(paint, unit_si, static_cast<double>(bar.h / (2.2f * line)))) {
    const float y = bar.bottom() - bar.h * static_cast<float>(map_share(paint, value * unit_si));
    const bool in_the_way = limit_share &&
                            std::abs(y - (bar.bottom() - bar.h * static_cast<float>(*limit_share))) < line &&
                            y > bar.y + 1.0f && y < bar.bottom() - 1.0f;
    if (in_the_way) continue;  // would overlap the limit's label
    draw.AddLine({bar.right() + 1, y}, {bar.right() + ui.px(4), y}, ui.colours.text_dim);
    draw.AddText(number, line, {bar.right() + ui.px(7), y - 0.5f * line}, ui.colours.text,
                 printed("%.4g", value).c_str());
  }
}

}  // namespace

float draw_map_bar(const UiContext& ui, AppModel& model, const Rect& view, float top) {
  MapView& map = model.map();
  const auto paint = map.paint();
  if (!paint) return 0.0f;
  const MapQuantityInfo& info = info_of(map.quantity);
  const UnitLabel unit = unit_of(map.quantity);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* number = ui.fonts.small_number;
  const std::string title = std::string(info.label) + (unit.name.empty() ? "" : ", " + std::string(unit.name));
  const float title_width = ui.fonts.small->CalcTextSizeA(ui.fonts.small->FontSize, 1e9f, 0.0f, title.c_str()).x;
  const float label_width = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, "0.00000").x;
  const float width =
      std::max(title_width, ui.px(kHistogramWidth + kBarWidth + 10.0f) + label_width) + 2.0f * ui.px(kPad);
  const float height = std::clamp(view.bottom() - top - ui.px(60), ui.px(90), ui.px(300));
  if (view.w < width + ui.px(60) || top + height + ui.px(50) > view.bottom()) return 0.0f;
  // A limit outside the range is marked beyond that end.
  const std::optional<double> limit = map.limit();
  const double limit_share = limit ? map_share(*paint, *limit) : 0.5;
  const float above = limit_share > 1.0 ? ui.px(kBeyond) : 0.0f, below = limit_share < 0.0 ? ui.px(kBeyond) : 0.0f;
  const Rect card{view.right() - width - ui.px(8), top, width, height + ui.px(34) + above + below};
  draw.AddRectFilled({card.x, card.y}, {card.right(), card.bottom()}, packed(with_alpha(ui.palette.panel, 0.84f)),
                     ui.px(4));
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {card.x + ui.px(kPad), card.y + ui.px(5)}, ui.colours.text,
               title.c_str());
  const Rect bar{card.x + ui.px(kPad + kHistogramWidth), card.y + ui.px(26) + above, ui.px(kBarWidth), height};

  draw_colours(ui, *paint, bar);
  draw_bins(ui, map.statistics(), bar);
  draw_numbers(ui, *paint, unit.in_si, bar, limit ? std::optional(limit_share) : std::nullopt);
  if (limit) draw_limit(ui, bar, limit_share, *limit / unit.in_si);
  ImGui::SetCursorScreenPos({card.x, card.y});
  ImGui::InvisibleButton("##map_bar", {card.w, card.h});
  ui.items.note_last("view/map_bar");
  drag_range(ui, map, *paint, bar);
  tooltip(ui,
          "Drag the upper half to move the upper end of the range, the lower half for the lower end; double click: "
          "automatic. "
          "The bars count places. Dark: not computed yet; grey: no value");
  return view.right() - card.x;
}

/// Tooltip with the value under the pointer.
void draw_map_hover(const UiContext& ui, MapView& map, std::uint32_t triangle, double u, double v) {
  const auto value = map.value_at(triangle, u, v);
  const auto paint = map.paint();
  if (!paint) return;
  const UnitLabel unit = unit_of(map.quantity);
  const std::string text =
      value ? printed("%.4g", *value / unit.in_si) + (unit.name.empty() ? "" : " " + std::string(unit.name))
            : "no value";
  const std::string where = printed("triangle %u", triangle);
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  ImFont* number = ui.fonts.number;
  ImFont* small = ui.fonts.small;
  const float w = std::max(number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, text.c_str()).x + ui.px(16),
                           small->CalcTextSizeA(small->FontSize, 1e9f, 0.0f, where.c_str()).x);
  const ImVec2 at{mouse.x + ui.px(16), mouse.y + ui.px(12)};
  draw.AddRectFilled({at.x - ui.px(6), at.y - ui.px(4)},
                     {at.x + w + ui.px(6), at.y + number->FontSize + small->FontSize + ui.px(8)},
                     packed(with_alpha(ui.palette.panel, 0.92f)), ui.px(3));
  if (value)
    draw.AddRectFilled({at.x, at.y + ui.px(2)}, {at.x + ui.px(10), at.y + ui.px(12)},
                       packed(map_colour(*paint, *value)), ui.px(2));
  draw.AddText(number, number->FontSize, {at.x + ui.px(16), at.y}, ui.colours.text, text.c_str());
  draw.AddText(small, small->FontSize, {at.x, at.y + number->FontSize + ui.px(3)}, ui.colours.text_dim, where.c_str());
}

}  // namespace tangent
