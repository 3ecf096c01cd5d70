#include "workbench/recording/overview.h"

#include <algorithm>
#include <limits>

namespace tangent {
namespace {

constexpr std::array<std::string_view, kOverviewChannels> kChannels{
    "t_s",          "finger_x_m",  "finger_y_m",       "finger_z_m",       "contact_x_m",
    "contact_y_m",  "contact_z_m", "penetration_m",    "force_x_n",        "force_y_n",
    "force_z_n",    "cld_m",       "error_m",          "solve_ns",         "tick_ns",
    "period_ns",    "lateness_ns", "device_force_x_n", "device_force_y_n", "device_force_z_n",
    "device_cld_m", "energy_j",    "iterations"};

using At = double& (*)(RecordedTick&);

/// Of all channels but the last, which is a whole number.
const std::array<At, kOverviewChannels - 1>& places() {
  static const auto all = [] {
    std::array<At, kOverviewChannels - 1> found{};
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const RealColumn& column : real_columns())
        if (column.name == kChannels[i]) found[i] = column.at;
    return found;
  }();
  return all;
}

}  // namespace

std::span<const std::string_view> overview_channels() { return kChannels; }

std::uint64_t overview_length(int level) {
  std::uint64_t length = kOverviewTicks;
  for (int i = 0; i < level; ++i) length *= kOverviewFactor;
  return length;
}

void OverviewRow::include(const OverviewRow& other) {
  if (ticks == 0) {
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
  }
  ticks += other.ticks;
  unconverged += other.unconverged;
  events += other.events;
  for (std::size_t i = 0; i < kOverviewChannels; ++i) {
    if (other.least[i] < least[i]) least[i] = other.least[i];
    if (other.most[i] > most[i]) most[i] = other.most[i];
  }
}

Status Overview::add(int level, const OverviewRow& row, const Keep& keep) {
  OverviewRow& open = open_[static_cast<std::size_t>(level)];
  const std::uint64_t length = overview_length(level), first = row.first_tick / length * length;
  if (open.ticks > 0 && open.first_tick != first) {
    if (Status ok = keep(open); !ok) return ok;
    if (level + 1 < kOverviewLevels)
      if (Status ok = add(level + 1, open, keep); !ok) return ok;
    open = {};
  }
  open.level = level;
  open.first_tick = first;
  open.include(row);
  return {};
}

Status Overview::add(RecordedTick& tick, const Keep& keep) {
  OverviewRow row;
  const TickOutput& output = tick.record.tick.output;
  row.first_tick = tick.record.tick.tick;
  row.ticks = 1;
  row.unconverged = is_converged(output.status) ? 0 : 1;
  row.events = output.event == TickEvent::none ? 0 : 1;
  for (std::size_t i = 0; i < places().size(); ++i) row.least[i] = row.most[i] = places()[i](tick);
  row.least.back() = row.most.back() = output.iterations;
  return add(0, row, keep);
}

Status Overview::finish(const Keep& keep) {
  for (int level = 0; level < kOverviewLevels; ++level) {
    OverviewRow& open = open_[static_cast<std::size_t>(level)];
    if (open.ticks == 0) continue;
    if (Status ok = keep(open); !ok) return ok;
    if (level + 1 < kOverviewLevels)
      if (Status ok = add(level + 1, open, keep); !ok) return ok;
    open = {};
  }
  return {};
}

}  // namespace tangent
