#include "workbench/recording/spectrum_figure.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr double kLeastDensity = 1e-18;  // smaller ones are drawn here: of what stands still nothing is left

struct DrawnDensity {
  const char *column, *label;
  std::vector<double> RoughnessSpectrum::*values;
};
constexpr DrawnDensity kDensities[]{
    {"force_n2_per_hz", "force [N^2/Hz]", &RoughnessSpectrum::force_n2_per_hz},
    {"display_mm2_per_hz", "display [mm^2/Hz]", &RoughnessSpectrum::display_mm2_per_hz}};

}  // namespace

Figure spectrum_figure(const std::string& name,
                       const std::vector<std::pair<std::string_view, const RoughnessSpectrum*>>& spectra) {
  Figure figure{.name = name,
                .title = "roughness by frequency: " + spectrum_text(*spectra.front().second),
                .width_px = 760,
                .height_px = 560};
  FigureTable table{{"hz"}, {}};
  for (const DrawnDensity& density : kDensities)
    for (std::size_t i = 0; i < spectra.size(); ++i)
      table.columns.push_back(density.column + (spectra.size() > 1 ? "_" + std::to_string(i + 1) : ""));
  const RoughnessSpectrum& first = *spectra.front().second;
  for (std::size_t k = 0; k < first.hz.size(); ++k) {
    std::vector<double> row{first.hz[k]};
    for (const DrawnDensity& density : kDensities)
      for (const auto& [title, spectrum] : spectra)
        row.push_back(k < spectrum->hz.size() ? std::max((spectrum->*density.values)[k], kLeastDensity)
                                              : kLeastDensity);
    table.rows.push_back(std::move(row));
  }
  figure.script = "F = DIR.'/" + name +
                  ".csv'\nset logscale xy\nset format y '10^{%T}'\nset key outside right top\n"
                  "set xtics (20,50,100,200,500,1000,2000,5000)\nset xrange [" +
                  std::to_string(first.hz.front()) + ":" + std::to_string(first.hz.back()) +
                  "]\nset multiplot layout 2,1 margins 0.12,0.82,0.11,0.97 spacing 0,0.05\n";
  std::size_t column = 1;
  for (const DrawnDensity& density : kDensities) {
    const bool last = &density == &kDensities[1];
    figure.script += last ? "set xlabel 'frequency [Hz]'\nset format x '%g'\n" : "unset xlabel\nset format x ''\n";
    figure.script += std::string("set ylabel '") + density.label + "'\nplot";
    for (std::size_t i = 0; i < spectra.size(); ++i, ++column) {
      figure.script += std::string(i > 0 ? "," : "") + " F using 'hz':'" + table.columns[column] + "' with lines ls " +
                       std::to_string(i + 1) + " lw 1.4";
      figure.script += spectra.size() > 1 ? " title '" + std::string(spectra[i].first) + "'" : " notitle";
    }
    figure.script += "\n";
  }
  figure.script += "unset multiplot\n";
  figure.data.push_back({"", std::move(table)});
  return figure;
}

std::string spectrum_text(const RoughnessSpectrum& spectrum) {
  return "Welch's power spectral density, Hann windows of " + std::to_string(spectrum.window_ticks) +
         " ticks, half over each other, " + std::to_string(spectrum.windows) + " of them";
}

}  // namespace tangent
