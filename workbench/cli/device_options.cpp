#include "workbench/cli/device_options.h"

#include "workbench/cli/option.h"

namespace tangent {

void add_device_options(CLI::App& command, DeviceChoice& choice) {
  add_text_option(command, "--device", choice.device,
                  "Devices to use: simulated, ideal, cld, maestro or none (default simulated)", "NAME");
  add_text_option(command, "--packets", choice.packets, "Write every USB packet into this file, as evidence", "F.txt");
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
}

}  // namespace tangent
