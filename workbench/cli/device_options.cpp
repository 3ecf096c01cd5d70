#include "workbench/cli/device_options.h"

#include "workbench/cli/falcon_options.h"
#include "workbench/cli/haply_options.h"
#include "workbench/cli/option.h"
#include "workbench/cli/plugin_options.h"
#include "workbench/cli/serial_options.h"
#include "workbench/cli/vendor_options.h"

namespace tangent {

namespace {

std::vector<std::string_view> views(const std::vector<std::string>& names) { return {names.begin(), names.end()}; }

void add_place_options(CLI::App& command, PlaceOptions& place) {
  add_flag(command, "--place-fit", place.fit, "Fit the scene, and a finger around it, to the force device's workspace");
  add_number_option(command, "--place-scale", {.min = Placement::kSmallestScale, .max = Placement::kLargestScale},
                    "Metres of the scene for a metre of the force device (default 1)",
                    [&place](double v) { place.scale = v; });
  add_vector_option(
      command, "--place-offset-mm", {.min = -1e6, .max = 1e6, .unit = "mm"},
      "Where the device's origin is in the scene (default: simulated in the mesh's centre, real at 0 0 0)",
      [&place](const auto& v) { place.offset_m = 1e-3 * Vec3(v[0], v[1], v[2]); });
  add_vector_option(command, "--place-rotate-deg", {.min = -360, .max = 360, .unit = "deg"},
                    "How the device's axes are turned in the scene: about x, then y, then z (default 0 0 0)",
                    [&place](const auto& v) {
                      place.rotation = rotation_from_degrees({v[0], v[1], v[2]});
                    });
  for (const char* other : {"--place-scale", "--place-offset-mm"}) exclude_each_other(command, "--place-fit", other);
}

}  // namespace

void add_driver_options(CLI::App& command, DeviceOptions& drivers) {
  // A driver is a line here: add_NAME_options(command, drivers.NAME).
  add_vendor_options(command, drivers.vendor);
  add_haply_options(command, drivers.haply);
  add_plugin_options(command, drivers.plugin);
  add_falcon_options(command, drivers.falcon);
  add_serial_options(command, drivers.serial);
}

void add_device_options(CLI::App& command, DeviceChoice& choice) {
  static const std::vector<std::string_view> forces = views(force_device_names());
  static const std::vector<std::string_view> displays = views(contact_display_names());
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  // Options take effect in this order: --force and --display say more than --device, wherever they stand.
  add_choice_option(command, "--device", displays,
                    "Short for both: that display, with the force device of the same name, or else the simulated one",
                    [&choice, at](int i) { choice.names = *devices_by_one_name(displays[at(i)]); });
  add_choice_option(command, "--force", forces, "Force device (default simulated)",
                    [&choice, at](int i) { choice.names.force = forces[at(i)]; });
  add_choice_option(command, "--display", displays, "Contact location display (default simulated)",
                    [&choice, at](int i) { choice.names.display = displays[at(i)]; });
  add_text_option(command, "--packets", choice.packets, "Log every USB packet to this file, for bug reports", "F.txt");
  add_number_option(command, "--servo-cpu", {.min = 0, .max = 1023, .whole = true},
                    "Processor core for the servo's thread alone (default: any)",
                    [&choice](double v) { choice.servo_cpu = static_cast<int>(v); });
  add_number_option(command, "--maestro-channel", {.min = 0, .max = 23, .whole = true},
                    "Channel the servo is on (default: as kept, or 0)",
                    [&choice](double v) { choice.maestro.channel = static_cast<unsigned>(v); });
  add_number_option(command, "--maestro-low-us", {.min = 400, .max = 2600, .unit = "us"},
                    "Pulse at the lower place (default: as kept, or 1000)",
                    [&choice](double v) { choice.maestro.low_us = v; });
  add_number_option(command, "--maestro-high-us", {.min = 400, .max = 2600, .unit = "us"},
                    "Pulse at the upper place (default: as kept, or 2000)",
                    [&choice](double v) { choice.maestro.high_us = v; });
  add_number_option(command, "--maestro-low-mm", {.min = -50, .max = 0, .unit = "mm"},
                    "The lower place (default: as kept, or -10)",
                    [&choice](double v) { choice.maestro.low_m = v * 1e-3; });
  add_number_option(command, "--maestro-high-mm", {.min = 0, .max = 50, .unit = "mm"},
                    "The upper place (default: as kept, or 10)",
                    [&choice](double v) { choice.maestro.high_m = v * 1e-3; });
  add_driver_options(command, choice.drivers);
  add_place_options(command, choice.place);
}

}  // namespace tangent
