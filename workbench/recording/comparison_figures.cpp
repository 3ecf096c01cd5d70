#include "workbench/recording/comparison_figures.h"

#include "workbench/recording/spectrum_figure.h"

#include <algorithm>
#include <string>

namespace tangent {
namespace {

struct DrawnChannel {
  std::string_view channel;
  const char* label;  ///< of the axis
  double scale;       ///< from SI
};
struct DrawnFigure {
  const char *name, *title;
  std::vector<DrawnChannel> channels;
};

const std::vector<DrawnFigure>& drawn_figures() {
  static const std::vector<DrawnFigure> kFigures{
      {"comparison-force",
       "force of both, and the largest difference",
       {{"force_x_n", "force x (N)", 1.0}, {"force_y_n", "force y (N)", 1.0}, {"force_z_n", "force z (N)", 1.0}}},
      {"comparison-display", "display of both, and the largest difference", {{"cld_m", "display (mm)", 1e3}}},
      {"comparison-solver",
       "penetration, error and iterations of both, and the largest difference",
       {{"penetration_m", "penetration (mm)", 1e3},
        {"error_m", "error (um)", 1e6},
        {"iterations", "iterations", 1.0}}}};
  return kFigures;
}

std::size_t channel_number(std::string_view name) {
  return static_cast<std::size_t>(std::find(kComparedChannels.begin(), kComparedChannels.end(), name) -
                                  kComparedChannels.begin());
}

FigureTable table_of(const RecordingsCompared& c, const DrawnFigure& figure, double seconds_per_tick) {
  FigureTable table{{"t_s"}, {}};
  for (std::size_t k = 0; k < figure.channels.size(); ++k)
    for (const char* what : {"least_a", "most_a", "least_b", "most_b", "difference"})
      table.columns.push_back(std::string(what) + std::to_string(k));
  for (const ComparedBin& bin : c.bins) {
    if (bin.ticks == 0) continue;
    std::vector<double> row{seconds_per_tick * static_cast<double>(bin.first)};
    for (const DrawnChannel& drawn : figure.channels) {
      const std::size_t i = channel_number(drawn.channel);
      for (const double value : {bin.least_a[i], bin.most_a[i], bin.least_b[i], bin.most_b[i], bin.at_most[i]})
        row.push_back(drawn.scale * value);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string script_of(const DrawnFigure& figure) {
  std::string script = "F = DIR.'/" + std::string(figure.name) + ".csv'\nset multiplot layout " +
                       std::to_string(2 * figure.channels.size()) + ",1 margins 0.1,0.8,0.1,0.97 spacing 0,0.03\n";
  for (std::size_t k = 0; k < figure.channels.size(); ++k) {
    const std::string n = std::to_string(k);
    const bool last = k + 1 == figure.channels.size();
    script += "unset xlabel\nset format x ''\nset key outside right top\nset ylabel '" +
              std::string(figure.channels[k].label) + "'\nplot F using 't_s':'least_a" + n + "':'most_a" + n +
              "' with filledcurves ls 1 fs transparent solid 0.5 title 'first', F using 't_s':'least_b" + n +
              "':'most_b" + n +
              "' with filledcurves ls 2 fs transparent solid 0.5 title 'second', F using 't_s':'most_a" + n +
              "' with lines ls 1 lw 1 notitle, F using 't_s':'most_b" + n + "' with lines ls 2 lw 1 notitle\n";
    if (last) script += "set xlabel 'time (s)'\nset format x '%g'\n";
    script += "set ylabel 'difference'\nset yrange [0:*]\nplot F using 't_s':'difference" + n +
              "' with lines ls 8 title 'largest'\nset yrange [*:*]\n";
  }
  return script + "unset multiplot\n";
}

}  // namespace

std::vector<Figure> comparison_figures(const RecordingsCompared& compared, double seconds_per_tick) {
  std::vector<Figure> figures;
  for (const DrawnFigure& drawn : drawn_figures()) {
    Figure figure{.name = drawn.name,
                  .title = drawn.title,
                  .width_px = 900,
                  .height_px = 120 + 260 * static_cast<int>(drawn.channels.size())};
    figure.data.push_back({"", table_of(compared, drawn, seconds_per_tick)});
    figure.script = script_of(drawn);
    figures.push_back(std::move(figure));
  }
  if (compared.spectrum_a.windows > 0)
    figures.push_back(
        spectrum_figure("comparison-spectrum", {{"first", &compared.spectrum_a}, {"second", &compared.spectrum_b}}));
  return figures;
}

}  // namespace tangent
