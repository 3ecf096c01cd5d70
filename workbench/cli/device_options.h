// Options that select the devices, the same for the window and the monitor.
#pragma once

#include "devices/device_set.h"
#include "workbench/session/maestro_setups.h"

#include <filesystem>
#include <memory>

namespace CLI {
class App;
}

namespace tangent {

struct DeviceChoice {
  DeviceNames names;
  MaestroWish maestro;
  std::filesystem::path packets;
};

/// --force, --display, --device for both, --packets, --maestro-channel, --maestro-low-us, --maestro-high-us,
/// --maestro-low-mm, --maestro-high-mm. `choice` must outlive the parsing.
void add_device_options(CLI::App& command, DeviceChoice& choice);

}  // namespace tangent
