#include "workbench/gui/plots/kept_bars.h"

#include <algorithm>

namespace tangent {

const std::vector<ColumnBar>& KeptBars::update(const ChannelStore& store, std::size_t channel, const TimeAxis& axis,
                                               float width_px) {
  const PixelColumns columns = pixel_columns(store, axis, width_px);
  const Source source{store.generation(), channel, columns.per_column};
  // Keeps columns that are still in view, whose ticks are still stored, and were complete when read.
  std::int64_t from = columns.first, to = columns.first;
  if (source == source_) {
    from = std::max(columns.first, first_);
    to = std::min(columns.end, first_ + static_cast<std::int64_t>(ranges_.size()));
    while (from < to && columns.tick_of(from) < store.first_tick()) ++from;
    while (from < to && columns.tick_of(to) > end_tick_) --to;
    if (from >= to) from = to = columns.first;
  }
  next_.resize(static_cast<std::size_t>(columns.end - columns.first));
  computed_ = 0;
  const auto compute = [&](std::int64_t begin, std::int64_t end) {
    const auto count = static_cast<std::size_t>(end - begin);
    columns.min_max(store, channel, begin,
                    std::span(next_).subspan(static_cast<std::size_t>(begin - columns.first), count));
    computed_ += count;
  };
  compute(columns.first, from);
  if (from < to)
    std::copy(ranges_.begin() + (from - first_), ranges_.begin() + (to - first_),
              next_.begin() + (from - columns.first));
  compute(to, columns.end);
  ranges_.swap(next_);
  source_ = source;
  first_ = columns.first;
  end_tick_ = store.end_tick();
  bars_.clear();
  for (std::int64_t column = columns.first; column < columns.end; ++column) {
    const MinMax& range = ranges_[static_cast<std::size_t>(column - columns.first)];
    if (!range.empty()) bars_.push_back({columns.x_of(column), range});
  }
  return bars_;
}

}  // namespace tangent
