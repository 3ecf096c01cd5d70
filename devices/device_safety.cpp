#include "devices/device_safety.h"

#include <algorithm>

namespace tangent {

namespace {

/// Of either kind. Many say what they can only once they are open: they are asked before and after.
template <class Device>
Status open_checked(Device& device) {
  if (const Status makes_sense = check_capabilities(device.capabilities()); !makes_sense) return makes_sense;
  if (const Status opened = device.open(); !opened) return opened;
  const Status makes_sense = check_capabilities(device.capabilities());
  if (!makes_sense) device.close();
  return makes_sense;
}

/// Between two samples of a device of this rate. A device that says less than the oldest sample allowed is not
/// believed.
double sample_time(double rate_hz, double longest_s) {
  constexpr double kUnknown_s = 1e-3;
  return rate_hz > 0.0 ? std::min(1.0 / rate_hz, longest_s) : kUnknown_s;
}

}  // namespace

Status open_device(ForceDevice& device) { return open_checked(device); }

Status open_devices(DeviceSet& devices) {
  if (devices.force)
    if (const Status ok = open_checked(*devices.force); !ok) return ok;
  const Status ok = devices.display ? open_checked(*devices.display) : Status{};
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
    limits.pushes_along = can.pushes_along;
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

Preset preset_allowed(Preset preset, const DeviceSet& devices, double scale) {
  if (!devices.force) return preset;
  const auto cap = [scale](double& value, double largest) {
    if (largest > 0.0) value = std::min(value, largest / scale);
  };
  const ForceCapabilities& can = devices.force->capabilities();
  cap(preset.force.stiffness_n_per_m, can.largest_stiffness_n_per_m);
  cap(preset.force.damping_n_s_per_m, can.largest_damping_n_s_per_m);
  return preset;
}

}  // namespace tangent
