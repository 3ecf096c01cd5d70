// The plots' curves: from the lists of channels to what is drawn.
#include "workbench/gui/model/plot_channels.h"
#include "workbench/gui/panels/plots_panel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tangent {
namespace {

/// Of derived curves: the first that the plot has not yet.
constexpr std::array kDerivedInks{&Palette::energy,     &Palette::cld_measured, &Palette::error,  &Palette::tick_time,
                                  &Palette::iterations, &Palette::force_y,      &Palette::accent, &Palette::force_x};

struct PlotAtFirst {
  const char* title;
  bool log = false, counts = false;
  const char* nothing = "no samples in view";
};
/// By kPlotIds.
constexpr std::array<PlotAtFirst, kPlotIds.size()> kAtFirst{
    PlotAtFirst{"Force"},
    PlotAtFirst{"Display"},
    PlotAtFirst{"Error", true},
    PlotAtFirst{"Iterations", false, true},
    PlotAtFirst{"Tick time", false, false, "simulated time: no clock"},
    PlotAtFirst{"Energy"}};

PlotSeries recorded_curve(const PlotChannel& channel) {
  PlotSeries series;
  series.name = series.full_name = channel.name;
  series.channel = channel.channel;
  series.colour = channel.colour;
  series.steps = channel.key == "iterations";
  series.ghost = channel.ghost;
  series.doc = channel.doc;
  series.key = channel.key;
  series.unit = channel.unit;
  series.scale = channel.scale;
  series.format = channel.format;
  return series;
}

PlotSeries derived_series(const NamedChannel& channel, std::size_t number) {
  PlotSeries series;
  series.name = series.full_name = channel.name;
  series.colour = kDerivedInks[number % kDerivedInks.size()];
  series.key = channel.key;
  series.unit = channel.unit;
  series.scale = channel.scale;
  series.format = "%8.4g";
  return series;
}

/// Of what the plot is named after.
bool is_own(const PlotSeries& series, std::size_t place) {
  return series.key.starts_with(kPlotIds[place]) && find_channel(series.key) != nullptr;
}

/// Another ink for a derived curve where the plot has its one already.
void tell_apart(PlotSeries& series, const std::vector<PlotSeries>& all) {
  const auto taken = [&](const auto& ink) {
    return std::any_of(all.begin(), all.end(), [&](const PlotSeries& s) { return &s != &series && s.colour == ink; });
  };
  if (!taken(series.colour)) return;
  const auto free = std::find_if_not(kDerivedInks.begin(), kDerivedInks.end(), taken);
  if (free != kDerivedInks.end()) series.colour = *free;
}

void follow_list(PlotView& plot, std::size_t place, const PlotLists::Texts& keys,
                 const std::vector<PlotSeries>& curves) {
  const std::vector<PlotSeries> before = std::exchange(plot.spec().series, {});
  PlotSpec& spec = plot.spec();
  for (const std::string& key : keys) {
    const auto curve = std::find_if(curves.begin(), curves.end(), [&](const PlotSeries& c) { return c.key == key; });
    if (curve == curves.end()) continue;
    PlotSeries& series = spec.series.emplace_back(*curve);
    const auto was = std::find_if(before.begin(), before.end(), [&](const PlotSeries& s) { return s.key == key; });
    if (was != before.end()) series.visible = was->visible;
    if (find_channel(key) == nullptr) tell_apart(series, spec.series);
  }
  const PlotAtFirst& first = kAtFirst[place];
  const bool titled = !spec.series.empty() && is_own(spec.series.front(), place);
  spec.title = titled ? first.title : "";
  for (PlotSeries& series : spec.series)
    if (titled && is_own(series, place)) series.name = find_channel(series.key)->short_name;
  // The first curve says what axis it is.
  const PlotChannel* leading = spec.series.empty() ? nullptr : find_channel(spec.series.front().key);
  spec.log = leading != nullptr && leading->key == "error";
  spec.counts = leading != nullptr && leading->key == "iterations";
  spec.scale = spec.series.empty() ? 1.0 : spec.series.front().scale;
  spec.unit = spec.series.empty() ? "" : spec.series.front().unit;
  for (const PlotSeries& series : spec.series)
    if (series.unit != spec.unit) spec.unit.clear();
  const auto same = [](const PlotSeries& a, const PlotSeries& b) { return a.key == b.key; };
  if (!std::equal(before.begin(), before.end(), spec.series.begin(), spec.series.end(), same)) plot.refit();
  spec.nothing = spec.series.empty() ? "drag a channel here (Channels, or a name over another plot)" : first.nothing;
}

}  // namespace

PlotsPanel make_plots_panel() {
  PlotsPanel panel;
  for (const std::string_view id : kPlotIds) {
    PlotSpec spec;
    spec.id = id;
    panel.plots.emplace_back(std::move(spec));
  }
  follow_lists(panel, PlotLists());
  return panel;
}

void follow_lists(PlotsPanel& state, const PlotLists& lists) {
  if (state.lists_version == lists.version()) return;
  state.lists_version = lists.version();
  state.curves.clear();
  for (const PlotChannel& channel : plot_channels()) state.curves.push_back(recorded_curve(channel));
  std::map<std::string, DerivedChannel> derived;
  for (const std::string& key : lists.made()) {
    const Result<NamedChannel> channel = named_channel(key);
    if (!channel) continue;
    state.curves.push_back(derived_series(*channel, state.curves.size()));
    if (const auto kept = state.derived.find(key); kept != state.derived.end())
      derived.emplace(key, std::move(kept->second));
    else
      derived.emplace(
          key, DerivedChannel{.of = channel->of, .of_ghost = ghost_of(channel->of), .recorded = {}, .ghost = {}});
  }
  state.derived = std::move(derived);
  for (std::size_t i = 0; i < kPlotIds.size(); ++i) follow_list(state.plots[i], i, lists.of(i), state.curves);
  std::erase_if(state.channels.chosen, [&](const std::string& key) {
    return std::none_of(state.curves.begin(), state.curves.end(), [&](const PlotSeries& c) { return c.key == key; });
  });
}

void update_derived(PlotsPanel& state, const TimeModel& time) {
  std::vector<PlotSeries*> of_derived;
  for (PlotView& plot : state.plots)
    for (PlotSeries& series : plot.spec().series) of_derived.push_back(&series);
  for (PlotSeries& series : state.curves)
    if (state.mode != PlotsMode::time && (series.key == state.x || series.key == state.y))
      of_derived.push_back(&series);
  std::erase_if(of_derived, [](const PlotSeries* series) { return find_channel(series->key) != nullptr; });
  std::set<std::string> shown;
  for (PlotSeries* series : of_derived) {
    const auto found = state.derived.find(series->key);
    if (found == state.derived.end()) continue;
    DerivedChannel& channel = found->second;
    const bool first = shown.insert(series->key).second;
    if (first) {
      channel.shown = &channel.recorded.update(time.store(), channel.of, time.tick_period_s());
      channel.shown_ghost = state.link.ghost != nullptr && channel.of_ghost
                                ? &channel.ghost.update(*state.link.ghost, *channel.of_ghost, time.tick_period_s())
                                : nullptr;
    }
    series->own = channel.shown;
    series->own_ghost = channel.shown_ghost;
  }
  for (auto& [key, channel] : state.derived) {
    if (shown.contains(key)) continue;
    channel.recorded = {};
    channel.ghost = {};
  }
  for (PlotSeries& series : state.curves)
    if (!shown.contains(series.key)) series.own = series.own_ghost = nullptr;
}

std::string with_unit(const PlotSeries& curve) {
  return curve.unit.empty() ? curve.full_name : curve.full_name + ", " + curve.unit;
}

const PlotSeries& curve_of(const PlotsPanel& state, const std::string& key) {
  const auto found =
      std::find_if(state.curves.begin(), state.curves.end(), [&](const PlotSeries& c) { return c.key == key; });
  return found == state.curves.end() ? state.curves.front() : *found;
}

}  // namespace tangent
