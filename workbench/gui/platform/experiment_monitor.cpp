#include "workbench/gui/platform/experiment_monitor.h"

namespace tangent {

std::optional<std::size_t> participant_monitor(std::span<const MonitorPlace> monitors, std::size_t operators) {
  for (std::size_t i = 0; i < monitors.size(); ++i) {
    if (i == operators || operators >= monitors.size()) continue;
    const MonitorPlace &a = monitors[i], &b = monitors[operators];
    const int x = a.x + a.width / 2, y = a.y + a.height / 2;
    const bool same = x >= b.x && x < b.x + b.width && y >= b.y && y < b.y + b.height;
    if (!same) return i;
  }
  return std::nullopt;
}

}  // namespace tangent
