#include "workbench/gui/plots/column_bars.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

std::uint64_t to_tick(double t) { return t <= 0.0 ? 0 : static_cast<std::uint64_t>(t); }

}  // namespace

void column_bars(const ChannelStore& store, std::size_t channel, const TimeAxis& axis, float width_px,
                 std::vector<ColumnBar>& out) {
  out.clear();
  if (store.empty() || width_px < 1.0f) return;
  const double per_column = axis.span() / static_cast<double>(width_px);
  const double begin = std::max(axis.from(), static_cast<double>(store.first_tick()));
  const double end = std::min(axis.to(), static_cast<double>(store.end_tick()));
  if (!(end > begin)) return;
  const double last = std::floor(end / per_column);
  for (double column = std::floor(begin / per_column); column <= last; column += 1.0) {
    const std::uint64_t from = to_tick(std::ceil(column * per_column));
    const std::uint64_t to = to_tick(std::ceil((column + 1.0) * per_column));
    const MinMax range = store.min_max(channel, from, to);
    if (range.empty()) continue;
    out.push_back({static_cast<float>((column * per_column - axis.from()) / per_column), range});
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
