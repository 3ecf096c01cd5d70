// Roughness of two recordings by frequency.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace tangent {
namespace {

constexpr double kLeastShare = 1e-6;  // of the largest density: smaller ones are drawn at the lower edge

/// Densities from the lower to the upper edge.
struct DensityRange {
  double least = 0.0, most = 0.0;
};

/// What is drawn of a spectrum.
struct DrawnDensity {
  const RoughnessSpectrum& of;
  const std::vector<double>& values;
  ImU32 ink;
};

DensityRange range_of(std::span<const DrawnDensity> all) {
  DensityRange range{std::numeric_limits<double>::infinity(), 0.0};
  for (const DrawnDensity& density : all)
    for (const double value : density.values) range = {std::min(range.least, value), std::max(range.most, value)};
  range.least = std::max(range.least, kLeastShare * range.most);
  return range;
}

void draw_density(ImDrawList& draw, const ImVec2& at, const ImVec2& size, const DrawnDensity& density,
                  const DensityRange& range) {
  const std::vector<double>& hz = density.of.hz;
  std::vector<ImVec2> line;
  for (std::size_t i = 0; i < hz.size(); ++i) {
    const double right = std::log(hz[i] / hz.front()) / std::log(hz.back() / hz.front());
    const double value = std::max(density.values[i], range.least);
    const double down = std::log(value / range.most) / std::log(range.least / range.most);
    line.emplace_back(at.x + size.x * static_cast<float>(right), at.y + size.y * static_cast<float>(down));
  }
  draw.AddPolyline(line.data(), static_cast<int>(line.size()), density.ink, 0, 1.0f);
}

}  // namespace

void draw_compared_spectra(const UiContext& ui, const RecordingsCompared& c, std::size_t channel) {
  const bool display = kComparedChannels[channel] == "cld_m";
  if (c.spectrum_a.windows == 0 || (!display && !kComparedChannels[channel].starts_with("force_"))) return;
  const auto drawn = [&](const RoughnessSpectrum& s, ImU32 ink) {
    return DrawnDensity{s, display ? s.display_mm2_per_hz : s.force_n2_per_hz, ink};
  };
  const DrawnDensity both[]{drawn(c.spectrum_a, ui.colours.accent), drawn(c.spectrum_b, ui.colours.warning)};
  const DensityRange range = range_of(both);
  if (!(range.most > range.least)) return;
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{ImGui::GetContentRegionAvail().x, ui.px(64)};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::InvisibleButton("##recordings/spectrum", size);
  ui.items.note_last("recordings/spectrum");
  draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ui.colours.plot, ui.px(2));
  for (const DrawnDensity& d : both) draw_density(draw, at, size, d, range);
  ImFont* font = ui.fonts.small_number;
  const std::string top = printed("%.3g ", range.most) + (display ? "mm^2/Hz" : "N^2/Hz");
  const std::string bottom = printed("%.0f to %.0f Hz", c.spectrum_a.hz.front(), c.spectrum_a.hz.back());
  const float right = at.x + size.x - ui.px(2);  // where spectra are low
  draw.AddText(font, font->FontSize, {right - font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, top.c_str()).x, at.y},
               ui.colours.text_faint, top.c_str());
  draw.AddText(font, font->FontSize, {at.x + ui.px(2), at.y + size.y - font->FontSize}, ui.colours.text_faint,
               bottom.c_str());
  tooltip(ui, printed("Roughness by frequency: power spectral density of %s, in windows of %zu ticks",
                      display ? "the display" : "the force's three coordinates together", c.spectrum_a.window_ticks));
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
