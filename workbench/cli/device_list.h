// What is attached, what it can do, why it can't be opened: for people, and for programs.
#pragma once

#include "devices/device_set.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tangent {

/// The simulated devices, what the force devices' drivers find, and the contact displays on USB. `report`: an array, an
/// entry for each that is attached or can't be looked for. Blocks for up to a second.
std::string list_devices(const DeviceOptions& options, nlohmann::json& report);

}  // namespace tangent
