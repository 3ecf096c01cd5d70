// What one curve looks like on a row of pixels: a vertical bar from minimum to maximum per pixel column
// when several ticks fall on one, single samples otherwise.
#pragma once

#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/time_axis.h"

#include <vector>

namespace tangent {

/// Above this many ticks a column, bars; below, the samples themselves joined by a line.
inline constexpr double kTicksPerColumnForBars = 3.0;

struct ColumnBar {
  float x = 0.0f;     ///< left edge of the column, pixels from the plot's left
  MinMax range;       ///< of the ticks in it
};

/// The columns that hold at least one sample, left to right. Columns are whole multiples of the ticks a
/// pixel holds, counted from tick 0, so that bars keep their shape while the axis scrolls. Exact.
void column_bars(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                 std::vector<ColumnBar>& out);

struct SamplePoint {
  float x = 0.0f;     ///< pixels from the plot's left
  float value = 0.0f;
  bool after_gap = false;  ///< don't join it to the one before
};

/// The samples in view and one beyond each end.
void sample_points(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                   std::vector<SamplePoint>& out);

}  // namespace tangent
