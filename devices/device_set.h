// The devices of a session, by name. Either may be missing.
#pragma once

#include "devices/contact_display.h"
#include "devices/force_device.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

struct DeviceSet {
  std::unique_ptr<ForceDevice> force;       ///< null: none
  std::unique_ptr<ContactDisplay> display;  ///< null: none
};

/// "simulated": force device and contact display with the figures of the real ones.
/// "ideal": the same without encoder steps and tremor.
/// "none": neither.
const std::vector<std::string>& device_set_names();

/// Not yet opened. Fails on an unknown name, naming the choices.
Result<DeviceSet> make_devices(std::string_view name, std::uint64_t seed);

}  // namespace tangent
