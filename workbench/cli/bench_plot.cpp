#include "workbench/cli/bench_plot.h"

#include "core/base/units.h"
#include "workbench/bench/method_style.h"
#include "workbench/cli/text_format.h"

#include <algorithm>

namespace tangent::bench {
namespace {

constexpr double kFloorUm = 1e-9;          // smaller errors are drawn here
constexpr double kMostUnconverged = 0.01;  // points with a larger share are not drawn
constexpr int kPanelPx = 330, kLeftPx = 80, kHeightPx = 400;

bool drawn(const WorkPrecisionPoint& p) { return p.unconverged_share <= kMostUnconverged && p.mean_ns > 0.0; }

FigureTable points_of(std::span<const WorkPrecisionReport> panels) {
  FigureTable table{{"panel", "method", "error_um", "ns"}, {}};
  for (std::size_t i = 0; i < panels.size(); ++i)
    for (const WorkPrecisionCurve& curve : panels[i].curves)
      for (const WorkPrecisionPoint& p : curve.points)
        if (drawn(p))
          table.rows.push_back({static_cast<double>(i), static_cast<double>(curve.method),
                                std::max(kFloorUm, p.error_p99_m / kMicrometre), p.mean_ns});
  return table;
}

const char* label_of(const MethodStyle& style) {
  return style.method == Method::paper ? "paper, best G_k" : style.label;
}

/// One panel's curves.
std::string plot_command(std::size_t panel) {
  std::string text;
  for (const MethodStyle& style : kMethodStyles)
    text += format(
        "%s F using (column('panel') == %zu && column('method') == %d ? column('error_um') : 1/0):'ns' "
        "with linespoints lw 1.8 pt %d ps %.2f lc rgb '%s' notitle",
        text.empty() ? "plot" : ",", panel, static_cast<int>(style.method), style.point, style.point_size,
        style.colour);
  return text + "\n";
}

/// One key for all panels, in a row above them: gnuplot's own is no wider than a panel.
std::string key_row(int width_px) {
  std::string text;
  double x = kLeftPx;
  for (const MethodStyle& style : kMethodStyles) {
    text += format("set label '%s' at screen %.4f,0.95 left offset 1,-0.22 point pt %d ps %.2f lc rgb '%s'\n",
                   label_of(style), x / width_px, style.point, style.point_size, style.colour);
    x += 48.0 + 6.5 * static_cast<double>(std::string_view(label_of(style)).size());
  }
  return text;
}

}  // namespace

Figure work_precision_figure(std::span<const WorkPrecisionReport> panels) {
  const auto count = std::max<std::size_t>(1, panels.size());
  Figure figure{.name = "work-precision", .title = "", .height_px = kHeightPx};
  figure.width_px = kLeftPx + static_cast<int>(count) * kPanelPx;
  figure.data.push_back({"", points_of(panels)});
  const double left = static_cast<double>(kLeftPx) / figure.width_px;
  figure.script =
      "F = DIR.'/work-precision.csv'\nset logscale xy\nset format '10^{%T}'\n"
      "stats F using 'error_um' name 'E' nooutput\nstats F using 'ns' name 'T' nooutput\n"
      "set xrange [10**floor(log10(E_min)):10**ceil(log10(E_max))]\n"
      "set yrange [10**floor(log10(T_min)):10**ceil(log10(T_max))]\n"
      "set xtics 1e-12,1e3\nunset mxtics\nset xlabel 'contact error, 99th percentile (\xC2\xB5m)'\n"
      "set ylabel 'time per tick, mean (ns)' offset 1,0\n" +
      key_row(figure.width_px) +
      format("set multiplot layout 1,%zu margins %.4f,0.985,0.16,0.82 spacing 0.03,0\n", count, left);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    // Scenes are named by this program.
    figure.script +=
        format("set title '%s, %u triangles' noenhanced offset 0,-0.6\n", panels[i].scene.c_str(), panels[i].triangles);
    figure.script += plot_command(i);
    if (i == 0) figure.script += "unset label\nunset ylabel\nset format y ''\n";
  }
  figure.script += "unset multiplot\n";
  return figure;
}

}  // namespace tangent::bench
