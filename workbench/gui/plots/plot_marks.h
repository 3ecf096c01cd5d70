// What happened, marked in every plot: events along the lower edge, changed parameters as dashed lines, bookmarks as
// flags on the upper edge.
#pragma once

#include "workbench/gui/plots/kept_bars.h"
#include "workbench/gui/plots/plot_area.h"
#include "workbench/gui/plots/time_axis.h"
#include "workbench/gui/widgets/ui_context.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace tangent {

struct TickMark {
  std::uint64_t tick = 0, last_tick = 0;
  std::string text;  ///< shown when pointed at
  ImU32 ink = 0;
};

struct PlotMarks {
  std::optional<std::size_t> event_channel;  ///< values 1, 2, ... are ranks; gaps where nothing happened
  std::span<const ImU32> event_inks;         ///< by rank - 1
  std::span<const TickMark> changes;         ///< of parameters
  std::span<const TickMark> flags;           ///< bookmarks
};

/// Inside the curves' clip rectangle. `events`: this plot's own. Returns the text of the mark that is pointed at; null:
/// none.
const std::string* draw_marks(const UiContext& ui, const PlotMarks& marks, const ChannelStore& store,
                              const TimeAxis& axis, const PlotArea& area, KeptBars& events);

}  // namespace tangent
