#include "workbench/gui/panels/recording_pair_curves.h"

#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {

ComparedUnit unit_of_compared(std::size_t channel) {
  const std::string_view name = kComparedChannels[channel];
  if (name.ends_with("_n")) return {1.0, "N"};
  if (name == "error_m") return {1e6, "\u00b5m"};
  if (name.ends_with("_m")) return {1e3, "mm"};
  return {1.0, ""};
}

namespace {

/// Rows of bars over the width, a column a bin.
struct BarPlot {
  ImDrawList& draw;
  ImVec2 at;
  float width, height;
  double low, high;
  float x(std::size_t i, std::size_t count) const {
    return at.x + width * static_cast<float>(i) / static_cast<float>(count);
  }
  float y(double value) const {
    const double share = high > low ? (value - low) / (high - low) : 0.5;
    return at.y + height * static_cast<float>(1.0 - share);
  }
  void bar(std::size_t i, std::size_t count, double least, double most, ImU32 ink) const {
    const float top = y(most), bottom = std::max(y(least), top + 1.0f);
    draw.AddRectFilled({x(i, count), top}, {std::max(x(i + 1, count), x(i, count) + 1.0f), bottom}, ink);
  }
};

void draw_labels(const UiContext& ui, const BarPlot& plot, const ComparedUnit& unit) {
  ImFont* font = ui.fonts.small_number;
  const auto label = [&](double value, float y) {
    plot.draw.AddText(font, font->FontSize, {plot.at.x + ui.px(2), y}, ui.colours.text_faint,
                      (printed("%.4g ", value * unit.scale) + unit.name).c_str());
  };
  label(plot.high, plot.at.y);
  label(plot.low, plot.at.y + plot.height - font->FontSize);
}

void draw_chosen(const UiContext& ui, const BarPlot& plot, const RecordingsCompared& c, std::uint64_t tick,
                 float height) {
  for (std::size_t i = 0; i < c.bins.size(); ++i) {
    const ComparedBin& bin = c.bins[i];
    if (tick < bin.first || tick >= bin.first + bin.ticks) continue;
    const float x = std::floor(0.5f * (plot.x(i, c.bins.size()) + plot.x(i + 1, c.bins.size())));
    plot.draw.AddRectFilled({x, plot.at.y}, {x + std::max(1.0f, ui.px(1)), plot.at.y + height}, ui.colours.text);
  }
}

}  // namespace

ComparedPointer draw_compared_curves(const UiContext& ui, const RecordingsCompared& c, std::size_t channel,
                                     std::optional<std::uint64_t> chosen) {
  const float width = ImGui::GetContentRegionAvail().x, height = ui.px(110), below = ui.px(56);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const bool pressed = ImGui::InvisibleButton("##recordings/plot", {width, height + below + ui.px(3)});
  ui.items.note_last("recordings/plot");
  double low = std::numeric_limits<double>::infinity(), high = -low, most = 0.0;
  for (const ComparedBin& bin : c.bins) {
    if (bin.ticks == 0) continue;
    low = std::min({low, bin.least_a[channel], bin.least_b[channel]});
    high = std::max({high, bin.most_a[channel], bin.most_b[channel]});
    most = std::max(most, bin.at_most[channel]);
  }
  if (!(low <= high)) return {};
  const BarPlot curves{draw, at, width, height, low, high};
  const BarPlot differences{draw, {at.x, at.y + height + ui.px(3)}, width, below, 0.0, most};
  for (const BarPlot* plot : {&curves, &differences})
    draw.AddRectFilled(plot->at, {plot->at.x + width, plot->at.y + plot->height}, ui.colours.plot, ui.px(2));
  const ImU32 ink_a = ui.colours.accent, ink_b = ui.colours.warning;
  const auto pale = [](ImU32 ink) { return (ink & 0x00FFFFFFu) | 0x90000000u; };
  for (std::size_t i = 0; i < c.bins.size(); ++i) {
    const ComparedBin& bin = c.bins[i];
    if (bin.ticks == 0) continue;
    curves.bar(i, c.bins.size(), bin.least_a[channel], bin.most_a[channel], pale(ink_a));
    curves.bar(i, c.bins.size(), bin.least_b[channel], bin.most_b[channel], pale(ink_b));
    differences.bar(i, c.bins.size(), 0.0, bin.at_most[channel], ui.colours.text_faint);
    if (bin.at_least[channel] > 0.0) differences.bar(i, c.bins.size(), 0.0, bin.at_least[channel], ui.colours.text_dim);
  }
  draw_labels(ui, curves, unit_of_compared(channel));
  draw_labels(ui, differences, unit_of_compared(channel));
  if (chosen) draw_chosen(ui, curves, c, *chosen, height + below + ui.px(3));
  if (!ImGui::IsItemHovered()) return {};
  const double across =
      static_cast<double>((ImGui::GetIO().MousePos.x - at.x) / width * static_cast<float>(c.bins.size()));
  const auto i = static_cast<std::size_t>(std::max(0.0, across));
  if (i >= c.bins.size() || c.bins[i].ticks == 0) return {};
  const ComparedBin& over = c.bins[i];
  if (!pressed) return {&over, std::nullopt};
  const auto into = static_cast<std::uint64_t>((across - std::floor(across)) * static_cast<double>(over.ticks));
  return {&over, over.first + std::min(into, over.ticks - 1)};
}

}  // namespace tangent
