#include "workbench/analysis/analysis_figures.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/lab/measure/perception_thresholds.h"
#include "core/lab/objects/arc.h"
#include "workbench/experiment/paper_results.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent::analysis {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kOurs = "#0072B2";
constexpr const char* kPapers = "#E69F00";
constexpr const char* kOther = "#D55E00";

std::string number(double value) {
  std::string out;
  append_double(out, value);
  return out;
}

/// Said at the upper right corner.
std::string mark(bool simulated) {
  const std::string plain = "set pointintervalbox 0\n";
  if (!simulated) return plain;
  return plain + "set label 'simulated participants' at screen 0.99, screen 0.975 right tc rgb '#B3261E' font ',12'\n";
}

/// Names below the axis, from 0; they come from protocols, which allow only known ones.
std::string name_tics(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += std::string(i > 0 ? ", " : "") + "'" + names[i] + "' " + std::to_string(i);
  return "set xtics (" + out + ")\nset xrange [-0.6:" + number(static_cast<double>(names.size()) - 0.4) + "]\n";
}

bool has_points(const FigureTable& table, const std::string& column) {
  const auto at =
      static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin());
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const std::vector<double>& row) { return std::isfinite(row[at]); });
}

/// A command of what has points alone: gnuplot complains of the rest. Empty where nothing has.
struct Plot {
  std::string text;
  void add(bool points, const std::string& series) {
    if (points) text += (text.empty() ? "plot " : ", ") + series;
  }
};

/// Bars with error bars: columns name_column, NAME, NAME_low, NAME_high, moved sideways.
std::string bars(const std::string& column, const std::string& title, const char* colour, double move, double width) {
  const std::string at = "(column('place')+" + number(move) + ")";
  return "F using " + at + ":'" + column + "':(" + number(width) + ") with boxes fs solid 0.55 noborder lc rgb '" +
         colour + "' title '" + title + "', F using " + at + ":'" + column + "_low':(0):(column('" + column +
         "_high')-column('" + column +
         "_low')) with vectors heads size screen 0.006,90 lw 1.2 lc rgb '#333333' notitle";
}

/// A logarithmic axis of segments around these values, labelled at 1, 2 and 5 times powers of ten.
std::string segments_axis(double low, double high) {
  return "set logscale y\nset ytics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000)\nset yrange [" +
         number(low / 1.4) + ":" + number(high * 1.5) + "]\n";
}

double half_of(const MeanInterval& interval) { return std::isfinite(interval.half) ? interval.half : 0.0; }

}  // namespace

Figure staircases_figure(std::span<const StaircaseResult> staircases, const std::string& name, bool simulated) {
  const std::size_t count = staircases.size();
  const int columns = count > 1 ? 2 : 1;
  const auto lines =
      static_cast<int>((count + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns));
  Figure figure{.name = name, .title = "Staircases", .width_px = columns * 420, .height_px = 40 + lines * 240};
  FigureTable table{{"condition", "trial", "right", "wrong", "reversal", "level"}, {}};
  for (std::size_t c = 0; c < count; ++c) {
    const StaircaseResult& one = staircases[c];
    for (std::size_t i = 0; i < one.levels.size(); ++i) {
      const double level = one.levels[i];
      const bool turned =
          std::find(one.reversals.begin(), one.reversals.end(), static_cast<int>(i)) != one.reversals.end();
      table.rows.push_back({static_cast<double>(c), static_cast<double>(i + 1), one.right[i] ? level : kNone,
                            one.right[i] ? kNone : level, turned ? level : kNone, level});
    }
  }
  figure.data.push_back({"", std::move(table)});
  figure.script = "F = DIR.'/" + name + ".csv'\n" + mark(simulated) + "set multiplot layout " + std::to_string(lines) +
                  "," + std::to_string(columns) + "\n" +
                  "set xlabel 'Trial' offset 0,0.4\nset ylabel 'Segments' offset 1.5,0\nset key off\n";
  for (std::size_t c = 0; c < count; ++c) {
    const StaircaseResult& one = staircases[c];
    const std::string only = "(column('condition')==" + std::to_string(c) + "?column('";
    const auto [low, high] = std::minmax_element(one.levels.begin(), one.levels.end());
    figure.script += segments_axis(*low, *high) + "set xrange [0:" + std::to_string(one.levels.size() + 1) + "]\n";
    figure.script +=
        "set title '" + one.condition +
        (one.segments ? ": threshold " + number(std::round(*one.segments * 10.0) / 10.0) : ": not settled") +
        "' offset 0,-0.6\n";
    const auto right = std::count(one.right.begin(), one.right.end(), 1);
    const auto series = [&](const std::string& column, const std::string& with) {
      return "F using 'trial':" + only + column + "'):1/0) with " + with;
    };
    Plot plot;
    plot.add(true, series("level", "lines lw 1 lc rgb '#999999'"));
    plot.add(right > 0, series("right", std::string("points pt 7 ps 0.55 lc rgb '") + kOurs + "'"));
    plot.add(right < one.trials, series("wrong", std::string("points pt 6 ps 0.7 lw 1.4 lc rgb '") + kOther + "'"));
    plot.add(!one.reversals.empty(), series("reversal", "points pt 4 ps 1.1 lw 1 lc rgb '#222222'"));
    plot.add(one.segments.has_value(), number(one.segments.value_or(0.0)) + " with lines ls 9");
    figure.script += plot.text;
    figure.script += c == 0 ? "\nunset label\n" : "\n";  // the mark stands above the first alone
  }
  figure.script += "unset multiplot\n";
  return figure;
}

Figure thresholds_figure(const ComparisonResults& results, bool simulated) {
  Figure figure{.name = "thresholds", .title = "Thresholds in segments", .width_px = 620, .height_px = 380};
  FigureTable table{{"place", "here", "here_low", "here_high", "paper", "paper_low", "paper_high"}, {}};
  std::vector<std::string> names;
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const ConditionResult& condition : results.conditions) {
    std::vector<double> row{static_cast<double>(names.size()), kNone, kNone, kNone, kNone, kNone, kNone};
    names.push_back(condition.condition);
    if (!condition.thresholds.empty()) {
      const double mean = condition.segments.mean;
      row[1] = mean;
      row[2] = std::isfinite(condition.low) ? condition.low : mean;  // the table's own ends
      row[3] = std::isfinite(condition.high) ? condition.high : mean;
    }
    for (const experiment::PaperThreshold& paper : experiment::kPaperThresholds) {
      if (paper.condition != condition.condition) continue;
      row[4] = paper.segments;
      row[5] = paper.segments - paper.half_interval;
      row[6] = paper.segments + paper.half_interval;
    }
    for (const PerceptionThreshold& pilot : kPerceptionThresholds)  // Table 2: an angle alone, of the pilot study
      if (!std::isfinite(row[4]) && pilot.condition == condition.condition)
        row[4] = row[5] = row[6] = 1.0 + kPaperArcRad / kDegree / pilot.mean_deg;
    for (std::size_t i = 1; i < row.size(); ++i) {
      if (!std::isfinite(row[i])) continue;
      low = std::min(low, row[i]);
      high = std::max(high, row[i]);
    }
    table.rows.push_back(std::move(row));
  }
  figure.data.push_back({"", std::move(table)});
  const auto points = [](const char* column, const char* title, const char* colour, double move, int point) {
    return std::string("F using (column('place')+") + number(move) + "):'" + column + "':'" + column + "_low':'" +
           column + "_high' with yerrorbars pt " + std::to_string(point) + " ps 0.9 lw 1.6 lc rgb '" + colour +
           "' title '" + title + "'";
  };
  const FigureTable& drawn = figure.data.front().table;
  Plot plot;
  plot.add(has_points(drawn, "here"), points("here", "here", kOurs, -0.07, 7));
  plot.add(has_points(drawn, "paper"), points("paper", "paper", kPapers, 0.07, 5));
  if (plot.text.empty()) return figure;
  figure.script = "F = DIR.'/thresholds.csv'\n" + mark(simulated) + name_tics(names) + segments_axis(low, high) +
                  "set ylabel 'Segments at threshold (mean, 95 % interval)'\n"
                  "set key at graph 0, graph 1.06 left bottom horizontal\nset tmargin 3\n" +
                  plot.text + "\n";
  return figure;
}

Figure accuracy_figure(const NamingResults& results, bool simulated) {
  Figure figure{.name = "accuracy", .title = "Right answers by object", .width_px = 700, .height_px = 380};
  FigureTable table{{"place", "here", "here_low", "here_high", "paper", "paper_low", "paper_high"}, {}};
  const ConfusionMatrix& matrix = results.parts.front().matrix;
  for (std::size_t i = 0; i < results.objects.size(); ++i) {
    std::vector<double> row{static_cast<double>(i), kNone, kNone, kNone, kNone, kNone, kNone};
    if (matrix.shown(i) > 0) {
      const RatioInterval share = share_interval(matrix.count(i, i), matrix.shown(i));
      row[1] = 100.0 * share.ratio;
      row[2] = 100.0 * share.low;
      row[3] = 100.0 * share.high;
    }
    for (std::size_t p = 0; p < experiment::kPaperObjects.size(); ++p)
      if (experiment::kPaperObjects[p] == results.objects[i])
        row[4] = row[5] = row[6] = experiment::kPaperConfusionPercent[p][p];
    table.rows.push_back(std::move(row));
  }
  figure.data.push_back({"", std::move(table)});
  const FigureTable& drawn = figure.data.front().table;
  Plot plot;
  plot.add(has_points(drawn, "here"), bars("here", "here, 95 % interval", kOurs, -0.2, 0.36));
  plot.add(has_points(drawn, "paper"),
           std::string("F using (column('place')+0.2):'paper':(0.36) with boxes fs solid 0.55 noborder lc rgb '") +
               kPapers + "' title 'paper, Table 3'");
  if (plot.text.empty()) return figure;
  figure.script =
      "F = DIR.'/accuracy.csv'\n" + mark(simulated) + name_tics(results.objects) +
      "set yrange [0:119]\nset ytics 0,20,100\nset ylabel 'Right answers [%]'\nset key right top horizontal\n" +
      plot.text + "\n";
  return figure;
}

Figure times_figure(const NamingResults& results, bool simulated) {
  Figure figure{.name = "times", .title = "Response time by object", .width_px = 700, .height_px = 380};
  FigureTable table{{"place", "since", "since_low", "since_high", "touching", "touching_low", "touching_high"}, {}};
  for (std::size_t i = 0; i < results.times.size(); ++i) {
    const ObjectTimes& t = results.times[i];
    const double a = t.response_s.mean, b = t.touching_s.mean, ha = half_of(t.response_s), hb = half_of(t.touching_s);
    table.rows.push_back({static_cast<double>(i), a, a - ha, a + ha, b, b - hb, b + hb});
  }
  figure.data.push_back({"", std::move(table)});
  figure.script = "F = DIR.'/times.csv'\n" + mark(simulated) + name_tics(results.objects) +
                  "set yrange [0:*]\nset offsets 0, 0, graph 0.2, 0\nset ylabel 'Time to a right answer [s]'\n"
                  "set key right top horizontal\nplot " +
                  bars("since", "since the first touch", kOurs, -0.2, 0.36) + ", " +
                  bars("touching", "of that, touching", "#009E73", 0.2, 0.36) + "\n";
  return figure;
}

Figure contact_figure(const NamingResults& results, bool simulated) {
  Figure figure{.name = "contact", .title = "Share of the time in contact", .width_px = 700, .height_px = 380};
  FigureTable table{{"place", "shaded", "shaded_low", "shaded_high", "unshaded", "unshaded_low", "unshaded_high"}, {}};
  for (std::size_t i = 0; i < results.times.size(); ++i) {
    const MeanInterval &s = results.times[i].share_shaded, &u = results.times[i].share_unshaded;
    const double hs = half_of(s), hu = half_of(u);
    table.rows.push_back({static_cast<double>(i), 100.0 * s.mean, 100.0 * (s.mean - hs), 100.0 * (s.mean + hs),
                          100.0 * u.mean, 100.0 * (u.mean - hu), 100.0 * (u.mean + hu)});
  }
  figure.data.push_back({"", std::move(table)});
  figure.script =
      "F = DIR.'/contact.csv'\n" + mark(simulated) + name_tics(results.objects) +
      "set yrange [0:119]\nset ytics 0,20,100\nset ylabel 'Time in contact [%]'\nset key right top horizontal\nplot " +
      bars("shaded", "shaded", kOurs, -0.2, 0.36) + ", " + bars("unshaded", "unshaded", kPapers, 0.2, 0.36) + "\n";
  return figure;
}

}  // namespace tangent::analysis
