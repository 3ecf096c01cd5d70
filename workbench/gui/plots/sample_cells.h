// Histograms over one channel or two (joint). Every sample of the range is counted, spread over several frames where
// there are many.
#pragma once

#include "workbench/gui/plots/channel_store.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

struct CellQuery {
  std::size_t x = 0;               ///< channel
  std::optional<std::size_t> y;    ///< empty: a histogram of x only
  std::uint64_t from = 0, to = 0;  ///< ticks
  std::size_t columns = 64, rows = 1;
  std::string of = {};  ///< which channels they are, where stores of one channel each are counted in turn
  bool operator==(const CellQuery&) const = default;
};

class SampleCells {
 public:
  static constexpr std::uint64_t kSamplesAFrame = 100'000;

  /// Call once per frame. Continues counting; once done, starts again if the query changed. Value ranges are the
  /// store's exact minima and maxima at the start.
  /// `y_store`: of channel y; null: the same.
  void update(const ChannelStore& store, const CellQuery& query, const ChannelStore* y_store = nullptr);

  /// Counts of the last finished query; empty: none yet.
  const std::vector<std::uint32_t>& counts() const { return done_.counts; }  ///< row by row
  const CellQuery& query() const { return done_.query; }
  MinMax x_range() const { return done_.x; }
  MinMax y_range() const { return done_.y; }
  std::uint64_t total() const { return done_.total; }
  std::uint32_t most() const { return done_.most; }
  bool busy() const { return busy_; }

 private:
  struct Count {
    CellQuery query;
    MinMax x, y;
    std::vector<std::uint32_t> counts;
    std::uint64_t total = 0;
    std::uint32_t most = 0;
  };
  void begin(const ChannelStore& store, const ChannelStore& y_store, const CellQuery& query);
  void go_on(const ChannelStore& store, const ChannelStore& y_store);

  Count done_, under_way_;
  std::uint64_t next_ = 0;
  bool busy_ = false, any_ = false;
};

}  // namespace tangent
