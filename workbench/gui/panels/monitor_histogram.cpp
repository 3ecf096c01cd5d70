#include "workbench/gui/panels/monitor_histogram.h"

#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kFloor_ns = 1000.0;  // durations below 1 us are drawn as 1 us

int column_of(std::uint64_t value, std::uint64_t least) {
  // The tolerance keeps exact powers of ten in their own column.
  return static_cast<int>(
      std::floor(std::log10(static_cast<double>(std::max(value, least))) * DecadeColumns::kPerDecade + 1e-9));
}

}  // namespace

DecadeColumns decade_columns(const LogHistogram& histogram, std::uint64_t least) {
  DecadeColumns columns;
  int first = 0, last = -1;
  for (std::size_t bin = 0; bin < LogHistogram::kBins; ++bin) {
    if (histogram.count_in(bin) == 0) continue;
    const int c = column_of(LogHistogram::top_of(bin), least);
    if (last < first) first = c;
    last = c;
  }
  if (last < first) return columns;
  columns.first = first;
  columns.counts.assign(static_cast<std::size_t>(last - first + 1), 0);
  for (std::size_t bin = 0; bin < LogHistogram::kBins; ++bin) {
    const std::uint64_t count = histogram.count_in(bin);
    if (count == 0) continue;
    const int c =
        std::clamp(column_of(LogHistogram::top_of(bin), least), first, last);  // another thread may have added counts
    std::uint64_t& column = columns.counts[static_cast<std::size_t>(c - first)];
    column += count;
    columns.most = std::max(columns.most, column);
  }
  return columns;
}

void draw_duration_histogram(const UiContext& ui, const char* title, const LogHistogram& histogram, double ns_per_count,
                             ImU32 ink, float height) {
  const double to_ms = ns_per_count * 1e-6;
  const auto least = static_cast<std::uint64_t>(std::max(1.0, kFloor_ns / ns_per_count));
  const DecadeColumns columns = decade_columns(histogram, least);
  const std::string numbers = columns.counts.empty() ? std::string("nothing yet")
                                                     : printed("p50 %.3g  p99 %.3g", histogram.percentile(0.5) * to_ms,
                                                               histogram.percentile(0.99) * to_ms);
  fact(ui, title, numbers, columns.counts.empty() ? "" : "ms");
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImFont* font = ui.fonts.small_number;
  const float bottom = at.y + height - font->FontSize - ui.px(3);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + width, bottom}, ui.colours.plot);
  ImGui::Dummy({width, height});
  // Whole decades around the data, at least three.
  const int per = DecadeColumns::kPerDecade;
  const int offset = static_cast<int>(std::lround(std::log10(to_ms)));  // value 10^k is 10^(k + offset) ms
  int low =
      columns.counts.empty() ? -offset - 2 : static_cast<int>(std::floor(static_cast<double>(columns.first) / per));
  int high = columns.counts.empty()
                 ? -offset + 1
                 : static_cast<int>(std::floor(
                       static_cast<double>(columns.first + static_cast<int>(columns.counts.size()) - 1) / per)) +
                       1;
  while (high - low < 3) (high - (-offset) <= -offset - low ? high : low) += high - (-offset) <= -offset - low ? 1 : -1;
  const float column_width = width / static_cast<float>((high - low) * per);
  for (int decade = low; decade <= high; ++decade) {
    const float x = std::round(at.x + static_cast<float>((decade - low) * per) * column_width);
    draw.AddLine({x, at.y}, {x, bottom}, ui.colours.grid);
    const std::string label = printed("%g", std::pow(10.0, decade + offset));
    const float w = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, label.c_str()).x;
    const float left = std::clamp(x - 0.5f * w, at.x, at.x + width - w);
    draw.AddText(font, font->FontSize, {left, bottom + ui.px(2)}, ui.colours.text_dim, label.c_str());
  }
  constexpr const char* kAxes = "ticks (log) against ms (log)";
  const ImFont* words = ui.fonts.small;
  draw.AddText(words, words->FontSize,
               {at.x + width - words->CalcTextSizeA(words->FontSize, 1e9f, 0.0f, kAxes).x - ui.px(3), at.y + ui.px(1)},
               ui.colours.text_dim, kAxes);
  // Logarithmic heights, so that one in ten thousand is visible.
  const double full = std::log10(static_cast<double>(columns.most) + 1.0);
  for (std::size_t i = 0; i < columns.counts.size(); ++i) {
    if (columns.counts[i] == 0) continue;
    const float x = at.x + static_cast<float>(columns.first + static_cast<int>(i) - low * per) * column_width;
    const double share = std::log10(static_cast<double>(columns.counts[i]) + 1.0) / full;
    const float top = bottom - static_cast<float>(share) * (bottom - at.y - ui.px(3));
    draw.AddRectFilled({x + 1.0f, top}, {x + std::max(column_width, 2.0f), bottom}, ink);
  }
}

}  // namespace tangent
