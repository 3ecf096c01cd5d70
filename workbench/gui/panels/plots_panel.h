// The plots: which curves there are, what the panel keeps between frames, and the functions that draw its parts.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/plots/derived_curve.h"
#include "workbench/gui/plots/plot_view.h"
#include "workbench/gui/plots/sample_cells.h"
#include "workbench/gui/plots/spectrum.h"
#include "workbench/gui/widgets/ui_context.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

enum class PlotsMode : std::uint8_t { time, xy, spectrum, histogram };

/// The list of channels beside the plots, and the line that makes a derived one.
struct ChannelsList {
  bool open = false;
  std::set<std::string> chosen;  ///< keys; dragged together
  int how = 1;                   ///< Derivation
  int a = 1, b = 0, c = 0, cutoff = 2;
};
/// A derived channel and what is computed of it.
struct DerivedChannel {
  ChannelExpression of;
  std::optional<ChannelExpression> of_ghost;
  DerivedCurve recorded, ghost;
  const ChannelStore *shown = nullptr, *shown_ghost = nullptr;  ///< of this frame
};
struct PlotsPanel {
  std::vector<PlotView> plots;                    ///< by their place in kPlotIds
  std::vector<PlotSeries> curves;                 ///< every channel that there is to choose from, recorded ones first
  std::uint64_t lists_version = 0;                ///< of the lists that `plots` and `curves` were made from
  std::map<std::string, DerivedChannel> derived;  ///< by key
  ChannelsList channels;
  PlotLink link;
  PlotsMode mode = PlotsMode::time;
  bool values = false;                       ///< the table of numbers beside the curves
  bool legend = false;                       ///< what the marks mean
  std::string x = "force_x", y = "force_z";  ///< channels of X-Y; spectrum and histogram show x
  SampleCells cells, ghost_cells;
  Spectrum spectrum, ghost_spectrum;
  std::uint64_t spectrum_ghost = 0;  ///< generation of the ghost in `ghost_spectrum`; 0: none
  std::string spectrum_of;           ///< channel, range and time of `spectrum`
  std::uint64_t spectrum_from = 0, spectrum_to = 0;
  double spectrum_at_s = -1.0;
  std::array<ImU32, 4> event_inks{};     ///< by EventRank - 1
  std::vector<TickMark> changes, flags;  ///< of this frame
};
PlotsPanel make_plots_panel();

/// Makes plots and curves follow the lists, where these have changed.
void follow_lists(PlotsPanel& state, const PlotLists& lists);
/// Computes the derived channels that are shown; the others are let go.
void update_derived(PlotsPanel& state, const TimeModel& time);
/// "Force x, N".
std::string with_unit(const PlotSeries& curve);
/// The curve of this key; the first where there is none.
const PlotSeries& curve_of(const PlotsPanel& state, const std::string& key);
/// Range [from, to) of the ticks in view that are in the history.
std::pair<std::uint64_t, std::uint64_t> ticks_in_view(const TimeModel& time);

void draw_plots_toolbar(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect, const Rect& whole);
/// A card over the plots: what the marks and lines in them mean.
void draw_plots_legend(const UiContext& ui, const PlotsPanel& state, const Rect& over);
/// The channels, to drag onto plots, and what makes another one.
void draw_channels_list(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect);
void draw_values_table(const UiContext& ui, TimeModel& time, PlotsPanel& state, const Rect& rect);
/// X-Y, spectrum or histogram.
void draw_other_plot(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect);
void draw_plots_panel(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect);

}  // namespace tangent
