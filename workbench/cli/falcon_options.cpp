#include "workbench/cli/falcon_options.h"

#include "devices/falcon/falcon_calibration.h"
#include "workbench/cli/option.h"

namespace tangent {

void add_falcon_options(CLI::App& command, FalconOptions& falcon) {
  add_text_option(command, "--falcon-serial", falcon.serial, "Serial number of the Falcon (default: the only one)",
                  "NUMBER");
  add_text_option(command, "--falcon-firmware", falcon.firmware,
                  "The Falcon's firmware, from its maker's installation (default: as kept, or what it runs)", "F.bin");
  add_text_option(command, "--falcon-firmware-sha256", falcon.firmware_sha256,
                  "Confirms a firmware file that is not known, by its digest", "DIGEST");
  add_number_option(command, "--falcon-torque-scale", {.min = kFalconLeastScale, .max = kFalconMostScale},
                    "Counts for 1 N m, measured with a spring scale (default: as kept, or not calibrated)",
                    [&falcon](double v) { falcon.torque_counts_per_nm = v; });
  add_flag(command, "--falcon-keep", falcon.keep, "Keep the values given here for this Falcon, by its serial number");
}

}  // namespace tangent
