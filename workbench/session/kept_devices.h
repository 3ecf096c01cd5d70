// The devices by name, with what is kept of them in the user's configuration folder. Reads files: not in the servo
// thread.
#pragma once

#include "devices/device_set.h"

namespace tangent {

/// make_devices, and for what the options don't give the values that were kept for that device by its serial number: of
/// a Falcon (falcon_setups.h). Fails as make_devices does, and where kept values are needed and can't be read.
Result<DeviceSet> make_devices_as_kept(const DeviceNames& names, DeviceOptions options);

}  // namespace tangent
