// Reduces a curve to pixel columns: a vertical bar from minimum to maximum where several ticks fall into a column,
// single samples otherwise.
#pragma once

#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/time_axis.h"

#include <vector>

namespace tangent {

/// Above this many ticks per column: bars; below: samples joined by a line.
inline constexpr double kTicksPerColumnForBars = 2.0;

struct ColumnBar {
  float x = 0.0f;  ///< left edge of the column, pixels from the plot's left
  MinMax range;    ///< of the ticks in it
};

/// Maps ticks to pixel columns. A column is one pixel wide or up to a ninth narrower: from eight ticks on it holds 8 to
/// 15 times a power of two ticks, so that it takes a few adjacent reads of the store's pyramid. Columns are counted
/// from tick 0, so that bars keep their shape while the axis scrolls.
struct PixelColumns {
  double per_column = 1.0;                           ///< ticks
  double per_pixel = 1.0;                            ///< ticks; at least per_column
  double left_tick = 0.0;                            ///< at the plot's left
  std::int64_t first = 0, end = 0;                   ///< one past the last
  std::uint64_t tick_of(std::int64_t column) const;  ///< first tick of a column
  float x_of(std::int64_t column) const;             ///< pixels from the plot's left
  /// For out.size() columns from `column` on.
  void min_max(const ChannelStore& store, std::size_t channel, std::int64_t column, std::span<MinMax> out) const;
};
PixelColumns pixel_columns(const ChannelStore& store, const TimeAxis& axis, float width_px);

/// The columns with at least one sample, left to right. Exact.
void column_bars(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                 std::vector<ColumnBar>& out);

struct SamplePoint {
  float x = 0.0f;  ///< pixels from the plot's left
  float value = 0.0f;
  bool after_gap = false;  ///< not joined to the previous sample
};

/// The samples in view and one beyond each end.
void sample_points(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                   std::vector<SamplePoint>& out);

}  // namespace tangent
