#include "workbench/recording/overview.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tangent {
namespace {

constexpr std::array<std::string_view, kOverviewChannels> kChannels{
    "t_s",          "finger_x_m",       "finger_y_m",       "finger_z_m",
    "contact_x_m",  "contact_y_m",      "contact_z_m",      "penetration_m",
    "force_x_n",    "force_y_n",        "force_z_n",        "cld_m",
    "error_m",      "solve_ns",         "tick_ns",          "period_ns",
    "lateness_ns",  "device_force_x_n", "device_force_y_n", "device_force_z_n",
    "device_cld_m", "energy_j",         "iterations",       "command_cld_m",
    "force_n",      "command_force_n",  "event_rank"};

using Of = double (*)(RecordedTick&);
using At = double& (*)(RecordedTick&);

/// Of a column, null for the channels that are none.
const std::array<At, kOverviewChannels>& places() {
  static const auto all = [] {
    std::array<At, kOverviewChannels> found{};
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const RealColumn& column : real_columns())
        if (column.name == kChannels[i]) found[i] = column.at;
    return found;
  }();
  return all;
}

/// The channels that are no REAL column.
constexpr std::array<std::pair<std::string_view, Of>, 4> kOthers{
    {{"iterations", [](RecordedTick& t) -> double { return t.record.tick.output.iterations; }},
     {"force_n", [](RecordedTick& t) -> double { return glm::length(t.record.tick.output.force_n); }},
     {"command_force_n", [](RecordedTick& t) -> double { return glm::length(t.record.device.force_command_n); }},
     {"event_rank", [](RecordedTick& t) -> double { return event_rank(t.record); }}}};

}  // namespace

std::span<const std::string_view> overview_channels() { return kChannels; }

std::size_t overview_channel(std::string_view name) {
  return static_cast<std::size_t>(std::find(kChannels.begin(), kChannels.end(), name) - kChannels.begin());
}

int event_rank(const ServoRecord& record) {
  const DeviceTelemetry& device = record.device;
  if (device.gate_fault != GateFault::none || device.force_fault != DeviceFault::none ||
      device.display_fault != DeviceFault::none)
    return 4;
  if (!is_converged(record.tick.output.status)) return 3;
  switch (record.tick.output.event) {
    case TickEvent::reseed:
      return 2;
    case TickEvent::switched:
    case TickEvent::branch:
      return 1;
    default:
      return 0;
  }
}

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
  for (std::size_t i = 0; i < kOverviewChannels; ++i)
    if (places()[i] != nullptr) row.least[i] = row.most[i] = places()[i](tick);
  for (const auto& [name, value] : kOthers) {
    const std::size_t i = overview_channel(name);
    row.least[i] = row.most[i] = value(tick);
  }
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
