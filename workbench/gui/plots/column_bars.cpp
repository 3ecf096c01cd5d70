#include "workbench/gui/plots/column_bars.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

std::uint64_t to_tick(double t) { return t <= 0.0 ? 0 : static_cast<std::uint64_t>(t); }

/// Ticks per column for `per_pixel` ticks per pixel, rounded down to 8 to 15 times a power of two, by at most a ninth.
double whole_blocks(double per_pixel) {
  constexpr double least = 8.0;
  if (per_pixel < least) return per_pixel;
  double unit = 1.0;
  while (unit * 2.0 * least <= per_pixel && unit < ChannelStore::kLargestBlock) unit *= 2.0;
  return std::floor(per_pixel / unit) * unit;
}

}  // namespace

std::uint64_t PixelColumns::tick_of(std::int64_t column) const {
  return to_tick(std::ceil(static_cast<double>(column) * per_column));
}

float PixelColumns::x_of(std::int64_t column) const {
  return static_cast<float>((static_cast<double>(column) * per_column - left_tick) / per_pixel);
}

void PixelColumns::min_max(const ChannelStore& store, std::size_t channel, std::int64_t column,
                           std::span<MinMax> out) const {
  if (per_column == std::floor(per_column))
    return store.min_max_row(channel, tick_of(column), static_cast<std::uint64_t>(per_column), out);
  for (std::size_t i = 0; i < out.size(); ++i, ++column)
    out[i] = store.min_max(channel, tick_of(column), tick_of(column + 1));
}

PixelColumns pixel_columns(const ChannelStore& store, const TimeAxis& axis, float width_px) {
  PixelColumns columns;
  if (store.empty() || width_px < 1.0f) return columns;
  columns.per_pixel = axis.span() / static_cast<double>(width_px);
  columns.per_column = whole_blocks(columns.per_pixel);
  columns.left_tick = axis.from();
  const double begin = std::max(axis.from(), static_cast<double>(store.first_tick()));
  const double end = std::min(axis.to(), static_cast<double>(store.end_tick()));
  if (!(end > begin)) return columns;
  columns.first = static_cast<std::int64_t>(std::floor(begin / columns.per_column));
  columns.end = static_cast<std::int64_t>(std::floor(end / columns.per_column)) + 1;
  return columns;
}

void column_bars(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                 std::vector<ColumnBar>& out) {
  out.clear();
  const PixelColumns columns = pixel_columns(store, axis, width_px);
  static thread_local std::vector<MinMax> ranges;
  ranges.resize(static_cast<std::size_t>(columns.end - columns.first));
  columns.min_max(store, channel, columns.first, ranges);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (!ranges[i].empty()) out.push_back({columns.x_of(columns.first + static_cast<std::int64_t>(i)), ranges[i]});
  }
}

void sample_points(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                   std::vector<SamplePoint>& out) {
  out.clear();
  if (store.empty() || width_px < 1.0f) return;
  const std::uint64_t from = std::max(store.first_tick(), to_tick(std::floor(axis.from())));
  const std::uint64_t to = std::min(store.end_tick(), to_tick(std::ceil(axis.to()) + 1.0));
  const double scale = static_cast<double>(width_px) / axis.span();
  bool gap = true;
  for (std::uint64_t tick = from; tick < to; ++tick) {
    const float value = store.value(channel, tick);
    if (std::isnan(value)) {
      gap = true;
      continue;
    }
    out.push_back({static_cast<float>((static_cast<double>(tick) - axis.from()) * scale), value, gap});
    gap = false;
  }
}

}  // namespace tangent
