#include "workbench/gui/panels/plot_figure.h"

#include "workbench/gui/plots/spectrum.h"
#include "workbench/gui/theme/palette.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr std::uint64_t kMostRows = 4000;  ///< of a curve against time
constexpr std::uint64_t kMostLined = 8000;
constexpr std::size_t kBins = 96;

struct Ticks {
  std::uint64_t from = 0, to = 0;
  std::uint64_t count() const { return to - from; }
};

std::string colour_of(const PlotSeries& series) {
  return printed("'#%06x'", [&] {
    const std::uint32_t abgr = packed(palette(Theme::light).*series.colour);
    return ((abgr & 255u) << 16) | (abgr & 0xff00u) | ((abgr >> 16) & 255u);
  }());
}

/// "Force [N]", as papers write it.
std::string axis_label(const std::string& name, const std::string& unit) {
  if (name.empty()) return unit.empty() ? unit : "[" + unit + "]";
  return unit.empty() ? name : name + " [" + unit + "]";
}
std::string label_of(const PlotSeries& curve) { return axis_label(curve.full_name, curve.unit); }

double shown_value(const PlotSeries& curve, float value) { return static_cast<double>(value) * curve.scale; }
double drawn_value(const PlotSpec& plot, const PlotSeries& curve, float value) {
  const double shown = shown_value(curve, value);
  return plot.log && shown < plot.floor ? plot.floor : shown;
}

/// A series in a table: the column of its values, from 1.
struct Drawn {
  const PlotSpec* plot;
  const PlotSeries* series;
  const ChannelStore* store;
  std::size_t channel = 0, column = 0;
  bool ghost = false;
};

/// What is on and has samples in view, in the order of the plots.
std::vector<Drawn> drawn_series(const PlotsPanel& state, const ChannelStore& store, const Ticks& ticks) {
  std::vector<Drawn> all;
  for (const PlotView& plot : state.plots)
    for (const PlotSeries& series : plot.spec().series) {
      const ChannelStore& own = series.store_in(store);
      if (!series.visible || own.min_max(series.channel, ticks.from, ticks.to).empty()) continue;
      all.push_back({&plot.spec(), &series, &own, series.channel, all.size() + 2});
      const ChannelStore* ghost = series.ghost_in(state.link.ghost);
      if (ghost == nullptr || ghost->min_max(series.ghost.value_or(0), ticks.from, ticks.to).empty()) continue;
      all.push_back({&plot.spec(), &series, ghost, series.ghost.value_or(0), all.size() + 2, true});
    }
  return all;
}

FigureTable time_table(const std::vector<Drawn>& curves, const Ticks& ticks, double period_s) {
  FigureTable table{{"t_s"}, {}};
  for (const Drawn& curve : curves)
    table.columns.push_back(curve.plot->id + "_" + std::to_string(curve.column) + (curve.ghost ? "_again" : ""));
  const std::uint64_t part = std::max<std::uint64_t>(1, 2 * ticks.count() / kMostRows);
  for (std::uint64_t tick = ticks.from; tick < ticks.to; tick += part)
    for (const bool largest : {false, true}) {
      if (largest && part == 1) continue;
      const double within = largest ? 0.5 * static_cast<double>(part) : 0.0;
      std::vector<double> row{(static_cast<double>(tick) + within) * period_s};
      for (const Drawn& curve : curves) {
        const MinMax range = curve.store->min_max(curve.channel, tick, std::min(ticks.to, tick + part));
        row.push_back(range.empty() ? std::nan("")
                                    : drawn_value(*curve.plot, *curve.series, largest ? range.max : range.min));
      }
      table.rows.push_back(std::move(row));
    }
  return table;
}

/// Counts of a few: a label for each.
bool whole_steps(const std::vector<Drawn>& plot, const Ticks& ticks) {
  MinMax range;
  for (const Drawn& curve : plot) range.include(curve.store->min_max(curve.channel, ticks.from, ticks.to));
  return plot.front().plot->counts && range.max - range.min <= 8.0f;
}

std::string curve_command(const Drawn& curve, bool alone) {
  const bool named = curve.plot->title.empty(), mixed = curve.plot->unit.empty();  // of several plots, or units
  const std::string name = (mixed ? axis_label(curve.series->name, curve.series->unit) : curve.series->name) +
                           (curve.ghost ? ", solved again" : "");
  return "F using 1:(column(" + std::to_string(curve.column) + ")) with " + (curve.series->steps ? "steps" : "lines") +
         " lc rgb " + colour_of(*curve.series) + (curve.ghost ? " lw 1.2 dt (6,3)" : " lw 1.4") +
         (alone && !curve.ghost && !named ? " notitle" : " title '" + name + "'");
}

/// Dashed lines at the measuring cursors.
std::string cursor_commands(const PlotLink& link, double period_s) {
  std::string text;
  for (const auto& [letter, tick] : {std::pair{"A", link.a}, std::pair{"B", link.b}}) {
    if (!tick) continue;
    const double at = static_cast<double>(*tick) * period_s;
    text += printed("set arrow from %.9g, graph 0 to %.9g, graph 1 nohead lc rgb '#777777' dt (4,3) lw 0.8\n", at, at);
    text += printed("set label '%s' at %.9g, graph 1 offset 0.3,-0.6 tc rgb '#777777'\n", letter, at);
  }
  return text;
}

Figure time_figure(const PlotsPanel& state, const std::vector<Drawn>& curves, const Ticks& ticks, double period_s) {
  std::vector<std::vector<Drawn>> plots;
  for (const Drawn& curve : curves) {
    if (plots.empty() || plots.back().front().plot != curve.plot) plots.emplace_back();
    plots.back().push_back(curve);
  }
  const int count = static_cast<int>(plots.size());
  constexpr double kAbove = 26.0, kBetween = 30.0, kPlot = 104.0, kBelow = 72.0;  // pixels
  const double height = kAbove + count * kPlot + (count - 1) * kBetween + kBelow;
  Figure figure{.name = "plots", .title = "", .width_px = 700, .height_px = static_cast<int>(height)};
  figure.data.push_back({"", time_table(curves, ticks, period_s)});
  figure.script = "F = DIR.'/plots.csv'\nset key at graph 0, graph 1.27 left top horizontal\n" +
                  cursor_commands(state.link, period_s) +
                  printed("set xrange [%.9g:%.9g]\n", static_cast<double>(ticks.from) * period_s,
                          static_cast<double>(ticks.to) * period_s) +
                  printed("set multiplot layout %d,1 margins 0.125,0.975,%.4f,%.4f spacing 0,%.4f\n", count,
                          kBelow / height, 1.0 - kAbove / height, kBetween / height);
  for (const auto& plot : plots) {
    const PlotSpec& spec = *plot.front().plot;
    const bool last = &plot == &plots.back();
    figure.script += last ? "set format x '%g'\nset xlabel 'Time [s]'\n" : "set format x ''\nunset xlabel\n";
    figure.script += "set ylabel '" + axis_label(spec.title, spec.unit) + "' offset 1,0\n";
    figure.script += spec.log ? "set logscale y\nset format y '10^{%T}'\n" : "unset logscale y\nset format y '%g'\n";
    figure.script +=
        whole_steps(plot, ticks) ? "set ytics 1\nset offsets 0,0,0.2,0.2\n" : "set ytics autofreq\nset offsets\n";
    std::string drawn;
    for (const Drawn& curve : plot) drawn += (drawn.empty() ? "plot " : ", ") + curve_command(curve, plot.size() == 1);
    figure.script += drawn + "\n";
  }
  figure.script += "unset multiplot\n";
  return figure;
}

Figure one_plot(std::string commands, FigureTable table) {
  Figure figure{.name = "plots", .title = "", .width_px = 560, .height_px = 380};
  figure.data.push_back({"", std::move(table)});
  figure.script = "F = DIR.'/plots.csv'\n" + std::move(commands);
  return figure;
}

std::string axis_labels(const std::string& x, const std::string& y) {
  return "set xlabel '" + x + "'\nset ylabel '" + y + "'\n";
}

Figure xy_figure(const PlotSeries& x, const PlotSeries& y, const ChannelStore& common, const Ticks& ticks) {
  FigureTable table{{"x", "y"}, {}};
  const ChannelStore &across = x.store_in(common), &up = y.store_in(common);
  for (std::uint64_t tick = ticks.from; tick < ticks.to; ++tick) {
    const float a = across.value(x.channel, tick), b = up.value(y.channel, tick);
    if (std::isnan(a) || std::isnan(b))
      table.part();
    else
      table.rows.push_back({shown_value(x, a), shown_value(y, b)});
  }
  const char* style = ticks.count() <= kMostLined ? "lines lw 1.2" : "dots";
  return one_plot(axis_labels(label_of(x), label_of(y)) + "plot F using 1:2 with " + style + " lc rgb " + colour_of(y) +
                      " notitle\n",
                  std::move(table));
}

Figure spectrum_figure(const PlotSeries& curve, const ChannelStore& store, const Ticks& ticks, double period_s) {
  const Spectrum s = amplitude_spectrum(store, curve.channel, ticks.from, ticks.to, 1.0 / period_s);
  FigureTable table{{"hz", "amplitude"}, {}};
  for (std::size_t i = 1; i < s.amplitude.size(); ++i)
    table.rows.push_back({s.bin_hz * static_cast<double>(i), static_cast<double>(s.amplitude[i]) * curve.scale});
  return one_plot("set logscale xy\nset format y '10^{%T}'\n" +
                      axis_labels("Frequency [Hz]", "Amplitude of " + label_of(curve)) +
                      "plot F using 1:($2 > 0 ? $2 : 1/0) with lines lw 1.2 lc rgb " + colour_of(curve) + " notitle\n",
                  std::move(table));
}

Figure histogram_figure(const PlotSeries& curve, const ChannelStore& store, const Ticks& ticks) {
  const MinMax range = store.min_max(curve.channel, ticks.from, ticks.to);
  const double low = static_cast<double>(range.min), width = std::max(1e-300, static_cast<double>(range.max) - low);
  std::array<double, kBins> counts{};
  for (std::uint64_t tick = ticks.from; tick < ticks.to; ++tick) {
    const double value = static_cast<double>(store.value(curve.channel, tick));
    if (std::isnan(value)) continue;
    const double bin = std::clamp((value - low) / width * static_cast<double>(kBins), 0.0, kBins - 1.0);
    ++counts[static_cast<std::size_t>(bin)];
  }
  FigureTable table{{"middle", "ticks"}, {}};
  const double step = width / static_cast<double>(kBins) * curve.scale;
  for (std::size_t i = 0; i < kBins; ++i)
    table.rows.push_back({low * curve.scale + step * (static_cast<double>(i) + 0.5), counts[i]});
  return one_plot(axis_labels(label_of(curve), "Ticks") + "set yrange [0:*]\nset style fill solid 1 noborder\n" +
                      "plot F using 1:2 with boxes lc rgb " + colour_of(curve) + " notitle\n",
                  std::move(table));
}

}  // namespace

Result<Figure> plot_figure(const PlotsPanel& state, const TimeModel& time) {
  const auto [from, to] = ticks_in_view(time);
  const Ticks ticks{from, to};
  const ChannelStore& store = time.store();
  const auto nothing = [] {
    return fail("there is nothing to draw in view", "plots", "move the time axis to where samples are");
  };
  if (state.mode == PlotsMode::time) {
    const std::vector<Drawn> curves = drawn_series(state, store, ticks);
    if (curves.empty()) return nothing();
    return time_figure(state, curves, ticks, time.tick_period_s());
  }
  const PlotSeries &x = curve_of(state, state.x), &y = curve_of(state, state.y);
  const ChannelStore& of_x = x.store_in(store);
  if (of_x.min_max(x.channel, from, to).empty()) return nothing();
  if (state.mode == PlotsMode::xy) return xy_figure(x, y, store, ticks);
  if (state.mode == PlotsMode::histogram) return histogram_figure(x, of_x, ticks);
  Figure spectrum = spectrum_figure(x, of_x, ticks, time.tick_period_s());
  if (spectrum.data.front().table.rows.empty())
    return fail("64 ticks without a gap are needed for a spectrum", "plots", "show a longer part of the time axis");
  return spectrum;
}

}  // namespace tangent
