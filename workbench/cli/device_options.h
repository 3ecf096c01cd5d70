// Options that select the devices, the same for the window and the monitor.
#pragma once

#include "devices/device_set.h"
#include "workbench/session/maestro_setups.h"
#include "workbench/session/session.h"

#include <filesystem>
#include <memory>

namespace CLI {
class App;
}

namespace tangent {

/// Of --arm, the same for both.
inline constexpr const char* kArmText =
    "Arm at the start, with real devices, too (default: simulated ones only), once the finger is off the surface";

struct DeviceChoice {
  DeviceNames names;
  DeviceOptions drivers;  ///< of the real force devices
  MaestroWish maestro;
  std::filesystem::path packets;
  int servo_cpu = -1;
  PlaceOptions place;
};

/// Options of the drivers of real force devices, each in a file of its own (NAME_options.h). `drivers` must outlive the
/// parsing.
void add_driver_options(CLI::App& command, DeviceOptions& drivers);

/// --force, --display, --device for both, --packets, --servo-cpu, --maestro-channel, --maestro-low-us,
/// --maestro-high-us, --maestro-low-mm, --maestro-high-mm, --place-fit, --place-scale, --place-offset-mm,
/// --place-rotate-deg, and those of vendor_options.h. `choice` must outlive the parsing.
/// --place-rotate-deg, and those of plugin_options.h. `choice` must outlive the parsing.
void add_device_options(CLI::App& command, DeviceChoice& choice);

}  // namespace tangent
