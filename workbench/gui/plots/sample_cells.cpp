#include "workbench/gui/plots/sample_cells.h"

#include <algorithm>

namespace tangent {

namespace {

std::size_t cell_of(float value, const MinMax& range, std::size_t count) {
  if (!(range.max > range.min)) return 0;
  const double share = (static_cast<double>(value) - static_cast<double>(range.min)) /
                       (static_cast<double>(range.max) - static_cast<double>(range.min));
  return std::min(count - 1, static_cast<std::size_t>(std::max(0.0, share) * static_cast<double>(count)));
}

}  // namespace

void SampleCells::update(const ChannelStore& store, const CellQuery& query, const ChannelStore* y_store) {
  const ChannelStore& ys = y_store != nullptr ? *y_store : store;
  if (busy_ && under_way_.query.of != query.of) busy_ = false;  // its store is no longer the one given
  if (!busy_ && (!any_ || !(query == done_.query))) begin(store, ys, query);
  if (busy_) go_on(store, ys);
}

void SampleCells::begin(const ChannelStore& store, const ChannelStore& y_store, const CellQuery& query) {
  under_way_ = Count{};
  under_way_.query = query;
  under_way_.x = store.min_max(query.x, query.from, query.to);
  if (query.y) under_way_.y = y_store.min_max(*query.y, query.from, query.to);
  under_way_.counts.assign(query.columns * query.rows, 0);
  next_ = std::max(query.from, store.first_kept());
  busy_ = any_ = true;
}

void SampleCells::go_on(const ChannelStore& store, const ChannelStore& y_store) {
  Count& c = under_way_;
  const std::uint64_t end = std::min(c.query.to, store.end_kept()), stop = std::min(end, next_ + kSamplesAFrame);
  for (; next_ < stop; ++next_) {
    const float x = store.value(c.query.x, next_);
    if (std::isnan(x)) continue;
    std::size_t cell = cell_of(x, c.x, c.query.columns);
    if (c.query.y) {
      const float y = y_store.value(*c.query.y, next_);
      if (std::isnan(y)) continue;
      cell += c.query.columns * cell_of(y, c.y, c.query.rows);
    }
    c.most = std::max(c.most, ++c.counts[cell]);
    ++c.total;
  }
  if (next_ < end) return;
  done_ = std::move(under_way_);
  busy_ = false;
}

}  // namespace tangent
