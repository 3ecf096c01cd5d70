// What one curve looks like on a row of pixels: a vertical bar from minimum to maximum per pixel column
// when several ticks fall on one, single samples otherwise.
#pragma once

#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/time_axis.h"

#include <vector>

namespace tangent {

/// Above this many ticks a column, bars; below, the samples themselves joined by a line.
inline constexpr double kTicksPerColumnForBars = 2.0;

struct ColumnBar {
  float x = 0.0f;  ///< left edge of the column, pixels from the plot's left
  MinMax range;    ///< of the ticks in it
};

/// The columns that what is kept is drawn in. A column is a pixel wide or up to a ninth narrower: from eight ticks on
/// it holds 8 to 15 times a power of two, and then takes a few reads of the store's pyramid that lie side by side.
/// Columns are counted from tick 0, so that bars keep their shape while the axis scrolls.
struct PixelColumns {
  double per_column = 1.0;                           ///< ticks
  double per_pixel = 1.0;                            ///< ticks; at least per_column
  double left_tick = 0.0;                            ///< at the plot's left
  std::int64_t first = 0, end = 0;                   ///< one past the last
  std::uint64_t tick_of(std::int64_t column) const;  ///< its first; the next one's is one past its last
  float x_of(std::int64_t column) const;             ///< pixels from the plot's left
  /// Of out.size() columns from `column` on.
  void min_max(const ChannelStore& store, std::size_t channel, std::int64_t column, std::span<MinMax> out) const;
};
PixelColumns pixel_columns(const ChannelStore& store, const TimeAxis& axis, float width_px);

/// The columns that hold at least one sample, left to right. Exact.
void column_bars(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                 std::vector<ColumnBar>& out);

struct SamplePoint {
  float x = 0.0f;  ///< pixels from the plot's left
  float value = 0.0f;
  bool after_gap = false;  ///< don't join it to the one before
};

/// The samples in view and one beyond each end.
void sample_points(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                   std::vector<SamplePoint>& out);

}  // namespace tangent
