// The rows of a recording's ticks, read and checked one after the other.
#pragma once

#include "workbench/recording/database.h"
#include "workbench/recording/tick_columns.h"

#include <array>
#include <optional>

namespace tangent {

/// Ticks in order, a range of them.
class TickReader {
 public:
  /// False: there is no further one. `tick.record.tick.kept` is left as it is.
  Result<bool> next(RecordedTick& tick);

 private:
  friend class Recording;
  TickReader(Statement ticks, Statement devices) : ticks_(std::move(ticks)), devices_(std::move(devices)) {}
  Status read_row(RecordedTick& tick);
  Status read_reals(RecordedTick& tick, int column);
  Status read_odd(std::uint64_t tick, int column);
  Status read_devices(std::uint64_t tick);
  Statement ticks_, devices_;
  std::array<std::int64_t, 16> now_{}, next_{};  ///< states of the devices, and those from next_tick_ on
  std::optional<std::uint64_t> next_tick_;
  bool began_ = false;
  std::uint64_t default_mask_ = 0;  ///< REAL columns that the file does not have
  std::uint64_t odd_mask_ = 0;      ///< of the row: those that SQLite can't hold
  std::array<double, 64> odd_{};
};

}  // namespace tangent
