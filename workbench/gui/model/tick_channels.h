// The plots' channels and their values for a tick.
#pragma once

#include "workbench/recording/overview.h"
#include "workbench/session/session.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tangent {

/// Channels of the plots, SI.
enum class Channel : std::uint8_t {
  force_x,  ///< of the computed force
  force_y,
  force_z,
  force_computed,  ///< its size
  force_felt,      ///< size of what the safety gate let through to the device
  cld_commanded,
  cld_measured,
  error,
  iterations,
  tick_time,
  energy,  ///< observed by the safety gate: made by the loop > 0, stored by the hand < 0
  event,   ///< EventRank as a number; a gap where there was no event
  count_
};
inline constexpr std::size_t kChannelCount = static_cast<std::size_t>(Channel::count_);

/// Event marks of the plots, by event_rank(); a column of pixels shows the highest rank of its ticks.
enum class EventRank : std::uint8_t { moved = 1, reseeded, unconverged, fault };

/// One value per channel, SI.
std::array<float, kChannelCount> channel_row(const ServoRecord& record);

/// Least and largest of each channel over the ticks of a recording's overview, as two after each other; NaN: none.
std::array<float, 2 * kChannelCount> channel_ranges(const OverviewRow& row);

}  // namespace tangent
