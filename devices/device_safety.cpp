#include "devices/device_safety.h"

#include <algorithm>

namespace tangent {

namespace {

Status open_force(ForceDevice* device) {
  if (device == nullptr) return {};
  const Status makes_sense = check_capabilities(device->capabilities());
  return makes_sense ? device->open() : makes_sense;
}

Status open_display(ContactDisplay* device) {
  if (device == nullptr) return {};
  const Status makes_sense = check_capabilities(device->capabilities());
  return makes_sense ? device->open() : makes_sense;
}

/// Between two samples of a device of this rate. A device that says less than the oldest sample allowed is not
/// believed.
double sample_time(double rate_hz, double longest_s) {
  constexpr double kUnknown_s = 1e-3;
  return rate_hz > 0.0 ? std::min(1.0 / rate_hz, longest_s) : kUnknown_s;
}

}  // namespace

Status open_devices(DeviceSet& devices) {
  if (const Status ok = open_force(devices.force.get()); !ok) return ok;
  const Status ok = open_display(devices.display.get());
  if (!ok && devices.force) devices.force->close();
  return ok;
}

GateLimits gate_limits(const DeviceSet& devices, double rate_hz) {
  GateLimits limits;
  limits.period_s = 1.0 / rate_hz;
  if (devices.force) {
    const ForceCapabilities& can = devices.force->capabilities();
    limits.peak_force_n = can.peak_force_n;
    limits.continuous_force_n = can.continuous_force_n;
    limits.workspace_half_size_m = can.workspace_half_size_m;
    limits.resolution_m = can.position_resolution_m;
    limits.sample_s = sample_time(can.rate_hz, limits.stale_s);
  }
  if (devices.display) {
    const DisplayCapabilities& can = devices.display->capabilities();
    limits.display_travel_m = can.travel_m;
    limits.display_sample_s = sample_time(can.rate_hz, limits.stale_s);
    if (can.fastest_m_per_s > 0.0) limits.fastest_target_m_per_s = can.fastest_m_per_s;
  }
  return limits;
}

std::vector<std::string> devices_without_timeout(const DeviceSet& devices) {
  std::vector<std::string> names;
  const auto look = [&names](const auto* device) {
    if (device == nullptr) return;
    const auto& can = device->capabilities();
    if (!can.simulated && can.firmware_timeout_s <= 0.0) names.push_back(can.name);
  };
  look(devices.force.get());
  look(devices.display.get());
  return names;
}

double stiffness_allowed(const DeviceSet& devices, double stiffness_n_per_m) {
  const double largest = devices.force ? devices.force->capabilities().largest_stiffness_n_per_m : 0.0;
  return largest > 0.0 ? std::min(stiffness_n_per_m, largest) : stiffness_n_per_m;
}

}  // namespace tangent
