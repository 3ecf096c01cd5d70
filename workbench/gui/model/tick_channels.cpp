#include "workbench/gui/model/tick_channels.h"

#include <cmath>

namespace tangent {

namespace {

float event_of(const ServoRecord& r) {
  const auto rank = [](EventRank e) { return static_cast<float>(e); };
  if (r.device.gate_fault != GateFault::none || r.device.force_fault != DeviceFault::none ||
      r.device.display_fault != DeviceFault::none)
    return rank(EventRank::fault);
  if (!is_converged(r.tick.output.status)) return rank(EventRank::unconverged);
  switch (r.tick.output.event) {
    case TickEvent::reseed:
      return rank(EventRank::reseeded);
    case TickEvent::switched:
    case TickEvent::branch:
      return rank(EventRank::moved);
    default:
      return std::nanf("");
  }
}

}  // namespace

std::array<float, kChannelCount> channel_row(const ServoRecord& r) {
  const Vec3& f = r.tick.output.force_n;
  // Not measured in simulated time: a gap, not a zero.
  const float tick_time = r.tick_ns > 0.0 ? static_cast<float>(r.tick_ns * 1e-9) : std::nanf("");
  return {static_cast<float>(f.x),
          static_cast<float>(f.y),
          static_cast<float>(f.z),
          static_cast<float>(glm::length(f)),
          static_cast<float>(glm::length(r.device.force_command_n)),
          static_cast<float>(r.device.cld_command_m),
          static_cast<float>(r.device.cld_measured_m),
          static_cast<float>(r.tick.output.error_m),
          static_cast<float>(r.tick.output.iterations),
          tick_time,
          static_cast<float>(r.device.energy_j),
          event_of(r)};
}

}  // namespace tangent
