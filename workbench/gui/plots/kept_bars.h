// Caches the bars of one curve between frames, so that a frame only computes the new columns: when an hour of history
// scrolls, that is a column of pixels now and then.
#pragma once

#include "workbench/gui/plots/column_bars.h"

namespace tangent {

class KeptBars {
 public:
  /// Same result as column_bars(). Valid until the next call.
  const std::vector<ColumnBar>& update(const ChannelStore& store, std::size_t channel, const TimeAxis& axis,
                                       float width_px);
  /// Columns that the last update read from the store.
  std::size_t computed() const { return computed_; }

 private:
  struct Source {
    std::uint64_t generation = 0;
    std::size_t channel = 0;
    double per_column = 0.0;
    bool operator==(const Source&) const = default;
  };
  Source source_;
  std::int64_t first_ = 0;      ///< column of ranges_[0]
  std::vector<MinMax> ranges_;  ///< consecutive columns, empty ones included
  std::vector<MinMax> next_;
  std::uint64_t end_tick_ = 0;  ///< of the store when they were read
  std::vector<ColumnBar> bars_;
  std::size_t computed_ = 0;
};

}  // namespace tangent
