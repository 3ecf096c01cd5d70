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

/// Of --arm, the same for both.
inline constexpr const char* kArmText =
    "Let force in at the start, with real devices, too (default: simulated ones only); it waits until the finger is "
    "off "
    "the surface";

struct DeviceChoice {
  std::string device = "simulated";
  MaestroWish maestro;
  std::filesystem::path packets;
  int servo_cpu = -1;
};

/// --device, --packets, --maestro-channel, --maestro-low-us, --maestro-high-us, --maestro-low-mm, --maestro-high-mm,
/// --servo-cpu.
/// `choice` must outlive the parsing.
void add_device_options(CLI::App& command, DeviceChoice& choice);

}  // namespace tangent
