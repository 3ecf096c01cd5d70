#include "core/base/units.h"
#include "workbench/bench/method_style.h"
#include "workbench/bench/speed_curves_report.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

namespace tangent::bench {
namespace {

constexpr double kFigureFloorUm = 1e-9;  // smaller errors are drawn there
constexpr std::array kPeerPoints{9, 11, 13, 3};

[[gnu::format(printf, 1, 2)]] std::string script_line(const char* pattern, ...) {
  std::array<char, 500> text{};
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

std::vector<double> figure_row(double of, double swept, double error_m, const MedianInterval& mean) {
  return {of, swept, std::max(kFigureFloorUm, error_m / kMicrometre), mean.median, mean.low, mean.high};
}

/// Curves apart from each other by an empty row, in the order in which they are swept.
FigureTable figure_rows(const SpeedCurves& curves) {
  FigureTable table{{"curve", "swept", "error_um", "ns", "low_ns", "high_ns"}, {}};
  for (const CurvePoint& p : curves.points)
    if (p.errors.error_m.count > 0)
      table.rows.push_back(figure_row(static_cast<double>(p.setting.method), static_cast<double>(p.setting.swept),
                                      p.errors.error_m.p99, p.times.mean_ns));
  for (std::size_t i = 0; i < curves.peers.size(); ++i)
    if (curves.peers[i].error_m)
      table.rows.push_back(figure_row(static_cast<double>(kMeasuredMethods.size() + i), 0.0,
                                      curves.peers[i].error_m->p99, curves.peers[i].times.mean_ns));
  return table;
}

std::string only(std::size_t curve, Swept swept) {
  return script_line("(column('curve') == %zu && column('swept') == %d ? column('error_um') : 1/0)", curve,
                     static_cast<int>(swept));
}

bool has_method(const SpeedCurves& curves, Method method) {
  return std::any_of(curves.points.begin(), curves.points.end(),
                     [&](const CurvePoint& p) { return p.setting.method == method; });
}

std::string method_commands(const MethodStyle& style) {
  const auto curve = static_cast<std::size_t>(style.method);
  const std::string tolerance = only(curve, Swept::tolerance), limit = only(curve, Swept::iterations),
                    preset = only(curve, Swept::nothing);
  std::string text;
  if (is_smooth(style.method)) {
    text += "F using " + limit +
            script_line(":'ns' with linespoints lw 1 dt (3,3) pt 6 ps 0.5 lc rgb '%s' notitle, ", style.colour);
    text += "F using " + tolerance + script_line(":'ns' with lines lw 1.8 lc rgb '%s' notitle, ", style.colour);
    text += "F using " + tolerance +
            script_line(
                ":'ns':'low_ns':'high_ns' with yerrorbars lw 1.2 pt %d ps %.2f lc rgb "
                "'%s' title '%s', ",
                style.point, style.point_size, style.colour, style.label);
    return text + "F using " + preset +
           script_line(":'ns' with points pt 4 ps 1.3 lw 1.4 lc rgb '%s' notitle, ", style.colour);
  }
  return "F using " + preset +
         script_line(":'ns':'low_ns':'high_ns' with yerrorbars lw 1.2 pt %d ps %.2f lc rgb '%s' title '%s', ",
                     style.point, style.point_size, style.colour, style.label);
}

}  // namespace

Figure curves_figure(const SpeedCurves& curves) {
  Figure figure{.name = "speed-against-error", .title = "", .width_px = 820, .height_px = 470};
  figure.data.push_back({"", figure_rows(curves)});
  figure.script =
      "F = DIR.'/speed-against-error.csv'\nset logscale xy\nset format '10^{%T}'\n"
      "set xlabel 'Contact error, 99th percentile [\xC2\xB5m]'\nset ylabel 'Time of a tick, mean [ns]' offset 1,0\n"
      "set key outside right top\nset pointintervalbox 0\nset bars 0.6\n"
      "stats F using 'error_um' name 'E' nooutput\nstats F using 'ns' name 'T' nooutput\n"
      "set xrange [E_min/3:E_max*3]\nset yrange [T_min/2:T_max*2]\nplot ";
  for (const MethodStyle& style : kMethodStyles)
    if (has_method(curves, style.method)) figure.script += method_commands(style);
  for (std::size_t i = 0; i < curves.peers.size(); ++i) {
    if (!curves.peers[i].error_m) continue;
    figure.script += "F using " + only(kMeasuredMethods.size() + i, Swept::nothing) +
                     script_line(
                         ":'ns':'low_ns':'high_ns' with yerrorbars lw 1.2 pt %d ps 1.1 lc rgb '#7A869A' title "
                         "'%s', ",
                         kPeerPoints[i % kPeerPoints.size()], curves.peers[i].peer.name.c_str());
  }
  figure.script +=
      "1/0 with lines lw 1.8 lc rgb '#777777' title 'tolerance swept', "
      "1/0 with lines lw 1 dt (3,3) lc rgb '#777777' title 'iteration limit', "
      "1/0 with points pt 4 ps 1.3 lw 1.4 lc rgb '#777777' title 'as the preset has it'\n";
  return figure;
}

}  // namespace tangent::bench
