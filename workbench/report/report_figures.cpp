#include "workbench/report/report_figures.h"

#include "workbench/bench/method_style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace tangent {
namespace {

constexpr double kLeastErrorUm = 1e-9;  // smaller ones are drawn here

[[gnu::format(printf, 1, 2)]] std::string line(const char* pattern, ...) {
  std::array<char, 400> text{};
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text.data(), text.size(), pattern, arguments);
  va_end(arguments);
  return text.data();
}

struct Curve {
  Drawn what;
  const char* column;
  const char* title;  ///< empty: the panel's own
  const char* colour;
};
struct Panel {
  const char* label;
  bool log, steps;
  std::array<Curve, 2> curves;  ///< the second is left out where the devices took what was computed
  std::size_t count;
};

// The colours of these quantities in the window's plots are of two themes; these stand out on both grounds.
constexpr std::array kPanels{
    Panel{"Force [N]",
          false,
          false,
          {Curve{Drawn::sent_force_n, "sent_n", "after the gate", "#E69F00"},
           Curve{Drawn::force_n, "force_n", "computed", "#D55E00"}},
          2},
    Panel{"Depth [mm]", false, false, {Curve{Drawn::penetration_m, "penetration_mm", "", "#0072B2"}, {}}, 1},
    Panel{"Display [mm]",
          false,
          false,
          {Curve{Drawn::sent_display_m, "sent_display_mm", "after the gate", "#56B4E9"},
           Curve{Drawn::display_m, "display_mm", "computed", "#009E73"}},
          2},
    Panel{"Error [\xC2\xB5m]", true, false, {Curve{Drawn::error_m, "error_um", "", "#CC79A7"}, {}}, 1},
    Panel{"Planes", false, true, {Curve{Drawn::planes, "planes", "", "#7A869A"}, {}}, 1}};

double scale_of(Drawn what) {
  switch (what) {
    case Drawn::penetration_m:
    case Drawn::display_m:
    case Drawn::sent_display_m:
      return 1e3;
    case Drawn::error_m:
      return 1e6;
    case Drawn::force_n:
    case Drawn::sent_force_n:
    case Drawn::planes:
      break;
  }
  return 1.0;
}

double drawn_value(Drawn what, double value) {
  const double scaled = scale_of(what) * value;
  return what == Drawn::error_m ? std::max(scaled, kLeastErrorUm) : scaled;
}

/// Two rows a part: the least and the largest. A part without ticks is a gap in the curves.
FigureTable time_table(const RecordingSummary& sum) {
  FigureTable table{{"t_s"}, {}};
  for (const Panel& panel : kPanels)
    for (std::size_t i = 0; i < panel.count; ++i) table.columns.emplace_back(panel.curves[i].column);
  for (const TimePart& part : sum.parts) {
    if (part.ticks == 0) {
      const bool dense = sum.ticks >= RecordingSummary::kParts;  // else most parts are empty, and no gap
      if (dense && !table.rows.empty() && !table.rows.back().empty()) table.part();
      continue;
    }
    for (const bool largest : {false, true}) {
      if (largest && part.ticks == 1) continue;
      std::vector<double> row{largest ? part.to_s : part.from_s};
      for (const Panel& panel : kPanels)
        for (std::size_t i = 0; i < panel.count; ++i) {
          const Drawn what = panel.curves[i].what;
          row.push_back(drawn_value(what, (largest ? part.most : part.least)[static_cast<std::size_t>(what)]));
        }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

/// Dashed lines with their letters above the first panel; letters of lines that are close stand above each other.
std::string marks(const RecordingReport& report) {
  const double close_s = 0.02 * (report.info.last_s - report.info.first_s);
  std::string text;
  for (std::size_t i = 0; i < report.explained.size(); ++i) {
    const double at = report.explained[i].worst.t_s;
    int close = 0;
    for (std::size_t k = 0; k < i; ++k) close += std::abs(report.explained[k].worst.t_s - at) < close_s ? 1 : 0;
    text += line("set arrow from %.9g, graph 0 to %.9g, graph 1 nohead lc rgb '#777777' dt (4,3) lw 0.8\n", at, at);
    text += line("set label '%s' at %.9g, graph 1 center offset 0,%.1f tc rgb '#444444' font ',11'\n",
                 letter_of(i).c_str(), at, 0.5 + 0.8 * close);
  }
  return text;
}

/// Four steps or so of 1, 2 or 5 times a power of ten, from 0 or below: gnuplot's own labels run into each other in low
/// panels. 0: there is nothing but zeros.
double tic_step(const FigureTable& table, std::size_t column, std::size_t count) {
  double low = 0.0, high = 0.0;
  for (const auto& row : table.rows)
    for (std::size_t i = column; i < column + count && i < row.size(); ++i) {
      low = std::min(low, row[i]);
      high = std::max(high, row[i]);
    }
  const double rough = (high - low) / 4.0;
  if (!(rough > 0.0)) return 0.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= rough) return step * power;
  return 10.0 * power;
}

std::string panel_command(const Panel& panel, bool sent) {
  std::string text;
  for (std::size_t i = panel.count == 2 && !sent ? 1 : 0; i < panel.count; ++i) {
    const Curve& curve = panel.curves[i];
    const bool alone = panel.count == 1 || !sent;
    text += std::string(text.empty() ? "plot" : ",") + " F using 't_s':'" + curve.column + "' with " +
            (panel.steps ? "steps" : "lines") + " lw 1.4 lc rgb '" + curve.colour + "'" +
            (alone ? " notitle" : std::string(" title '") + curve.title + "'");
  }
  return text + "\n";
}

/// Whether the gate let force through at any time: else what it sent is nothing to look at.
bool has_sent(const RecordingSummary& sum) { return sum.armed > 0; }

}  // namespace

std::string letter_of(std::size_t explained) { return std::string(1, static_cast<char>('A' + explained % 26)); }

Figure time_figure(const RecordingReport& report, const std::string& name) {
  constexpr double kAbove = 52.0, kBetween = 34.0, kPlot = 96.0, kBelow = 62.0;  // pixels
  constexpr auto kCount = static_cast<double>(kPanels.size());
  const double height = kAbove + kCount * kPlot + (kCount - 1.0) * kBetween + kBelow;
  Figure figure{.name = name, .title = "", .width_px = 860, .height_px = static_cast<int>(height)};
  figure.data.push_back({"", time_table(report.summary)});
  const RecordingInfo& info = report.info;
  const double last_s = info.last_s > info.first_s ? info.last_s : info.first_s + 1e-3;
  figure.script = "F = DIR.'/" + name + ".csv'\nset key at graph 1, graph 1.02 right bottom horizontal samplen 1.5\n" +
                  line("set xrange [%.9g:%.9g]\n", info.first_s, last_s) + marks(report) +
                  line("set multiplot layout %zu,1 margins 0.1,0.985,%.4f,%.4f spacing 0,%.4f\n", kPanels.size(),
                       kBelow / height, 1.0 - kAbove / height, kBetween / height);
  std::size_t column = 1;
  for (const Panel& panel : kPanels) {
    const bool last = &panel == &kPanels.back();
    const double step = panel.log ? 0.0 : tic_step(figure.data.front().table, column, panel.count);
    figure.script += step > 0.0 || panel.log ? "set yrange [*:*]\n" : "set yrange [-1:1]\n";
    figure.script +=
        panel.log ? std::string("set ytics 1e-12,1e3\n") : line("set ytics %.9g\n", step > 0.0 ? step : 1.0);
    column += panel.count;
    figure.script += last ? "set format x '%g'\nset xlabel 'Time [s]'\n" : "set format x ''\nunset xlabel\n";
    figure.script += std::string("set ylabel '") + panel.label + "' offset 1,0\n";
    figure.script += panel.log ? "set logscale y\nset format y '10^{%T}'\n" : "unset logscale y\nset format y '%g'\n";
    figure.script += panel_command(panel, has_sent(report.summary));
    if (&panel == &kPanels.front()) figure.script += "unset label\n";  // letters stand above the first alone
  }
  figure.script += "unset multiplot\n";
  return figure;
}

Figure methods_figure(const bench::MethodComparison& methods, const std::string& name) {
  Figure figure{.name = name, .title = "", .width_px = 620, .height_px = 380};
  FigureTable table{{"method", "p50_um", "p99_um", "ns", "low_ns", "high_ns"}, {}};
  const auto shown = [](double error_m) { return std::max(1e6 * error_m, kLeastErrorUm); };
  for (const bench::ComparedMethod& m : methods.methods) {
    const double half = std::isfinite(m.typical_ns.half) ? m.typical_ns.half : 0.0;
    const double low = std::max(m.typical_ns.mean - half, 0.05 * m.typical_ns.mean);
    table.rows.push_back({static_cast<double>(m.method), shown(m.error_m.p50), shown(m.error_m.p99), m.typical_ns.mean,
                          low, m.typical_ns.mean + half});
  }
  figure.data.push_back({"", std::move(table)});
  figure.script =
      "F = DIR.'/" + name +
      ".csv'\nset logscale xy\nset format '10^{%T}'\nset xlabel 'Contact error [\xC2\xB5m]'\n"
      "set ylabel 'Time of a typical tick [ns]' offset 1,0\nset key outside right top\nset pointintervalbox 0\n"
      "set offsets graph 0.06, graph 0.06, graph 0.1, graph 0.1\n";
  std::string lines, points;
  for (const bench::MethodStyle& style : bench::kMethodStyles) {
    const std::string only = line("(column('method') == %d ? ", static_cast<int>(style.method));
    lines +=
        std::string(lines.empty() ? "plot" : ",") + " F using " + only +
        "column('p50_um') : 1/0):'ns':(column('p99_um')-column('p50_um')):(0) with vectors nohead lw 1.2 lc rgb '" +
        style.colour + "' notitle";
    points += ", F using " + only + "column('p99_um') : 1/0):'ns':'low_ns':'high_ns' with yerrorbars lw 1.4 pt " +
              std::to_string(style.point) + line(" ps %.2f", style.point_size) + " lc rgb '" + style.colour +
              "' title '" + style.label + "'";
  }
  figure.script += lines + points + "\n";
  return figure;
}

}  // namespace tangent
