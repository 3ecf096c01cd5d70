// Marks in every plot: events in a strip below the curves, parameter changes as dashed lines, bookmarks as flags on the
// upper edge.
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

/// Height of the events' strip, points.
inline constexpr float kEventStrip = 7.0f;

struct TickMark {
  std::uint64_t tick = 0, last_tick = 0;
  std::string text;  ///< shown on hover
  ImU32 ink = 0;
};

struct PlotMarks {
  std::optional<std::size_t> event_channel;  ///< values 1, 2, ... are ranks; gaps: no event
  std::span<const ImU32> event_inks;         ///< by rank - 1
  std::span<const TickMark> changes;         ///< parameter changes
  std::span<const TickMark> flags;           ///< bookmarks
};

/// Draws over the curves and, events, in the strip below them. `events`: this plot's own. Returns the text of the mark
/// under the pointer; null: none.
const std::string* draw_marks(const UiContext& ui, const PlotMarks& marks, const ChannelStore& store,
                              const TimeAxis& axis, const PlotArea& area, KeptBars& events);

}  // namespace tangent
