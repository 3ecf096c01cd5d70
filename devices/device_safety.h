// What devices say about themselves, used: nonsense is refused, limits become the gate's, and what a person has to know
// before arming is named.
#pragma once

#include "core/preset/preset.h"
#include "devices/device_set.h"
#include "devices/gate/limits.h"

#include <string>
#include <vector>

namespace tangent {

/// Opens them. Fails, with none left open, when one can't be opened or its capabilities make no sense (gate/limits.h),
/// before or once it is open.
Status open_devices(DeviceSet& devices);
/// The same for a force device alone.
Status open_device(ForceDevice& device);

/// Limits of the safety gate for these devices under a servo of this rate.
GateLimits gate_limits(const DeviceSet& devices, double rate_hz);

/// Names of the real devices that go on with their last command when the program dies: their firmware has no time-out.
std::vector<std::string> devices_without_timeout(const DeviceSet& devices);

/// What the force device may render of this preset. Its stiffness and damping, as they are felt at the device (`scale`
/// times, Placement::felt), are no more than the device's largest, where those are known.
Preset preset_allowed(Preset preset, const DeviceSet& devices, double scale = 1.0);

}  // namespace tangent
