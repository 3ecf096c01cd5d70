// Where the participant's window goes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace tangent {

/// A monitor's rectangle on the desktop.
struct MonitorPlace {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const MonitorPlace&) const = default;
};

/// The first monitor whose middle is not on `operators`, the monitor of the operator's window (two that show the
/// same are one). None: there is no other.
std::optional<std::size_t> participant_monitor(std::span<const MonitorPlace> monitors, std::size_t operators);

}  // namespace tangent
