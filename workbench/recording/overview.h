// A pyramid of minima and maxima over a recording's ticks, so that a plot of hours is drawn from a few thousand rows.
// Level 0 has a row for 256 ticks, each further level one for 16 of the level below.
#pragma once

#include "core/base/result.h"
#include "workbench/recording/tick_columns.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace tangent {

/// What the pyramid keeps. Those of a column have its name; besides, `force_n` and `command_force_n` are the sizes of
/// the forces, and `event_rank` is that of event_rank().
std::span<const std::string_view> overview_channels();
inline constexpr std::size_t kOverviewChannels = 27;
/// The number of a channel in it. Precondition: there is one of that name.
std::size_t overview_channel(std::string_view name);
inline constexpr int kOverviewLevels = 3;
inline constexpr std::uint64_t kOverviewTicks = 256, kOverviewFactor = 16;

/// What a tick stands out by, the highest of: 4 a fault of a device or the gate, 3 unconverged or facing, 2 reseeded, 1
/// moved to another place, 0 nothing.
int event_rank(const ServoRecord& record);

/// Those of its ticks that were recorded: `first_tick` is a multiple of its level's length.
struct OverviewRow {
  int level = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t ticks = 0, unconverged = 0, events = 0;
  /// Values that are not numbers are passed over. NaN: a channel that the file does not have.
  std::array<double, kOverviewChannels> least{}, most{};

  void include(const OverviewRow& other);
};

/// Ticks of a row of that level.
std::uint64_t overview_length(int level);

/// Plain values: a copy is what it was.
class Overview {
 public:
  using Keep = std::function<Status(const OverviewRow&)>;
  /// `keep` gets each row once, when a tick after its last one comes, or `finish`.
  Status add(RecordedTick& tick, const Keep& keep);
  Status finish(const Keep& keep);

 private:
  Status add(int level, const OverviewRow& row, const Keep& keep);
  std::array<OverviewRow, kOverviewLevels> open_{};  ///< of no ticks: none
};

}  // namespace tangent
