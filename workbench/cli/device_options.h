// Options that select the devices, the same for the window and the monitor.
#pragma once

#include "workbench/session/maestro_setups.h"

#include <filesystem>
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace tangent {

struct DeviceChoice {
  std::string device = "simulated";
  MaestroWish maestro;
  std::filesystem::path packets;
};

/// --device, --packets, --maestro-channel, --maestro-low-us, --maestro-high-us, --maestro-low-mm, --maestro-high-mm.
/// `choice` must outlive the parsing.
void add_device_options(CLI::App& command, DeviceChoice& choice);

}  // namespace tangent
