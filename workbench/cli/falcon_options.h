// Options of the force device "falcon", the same for all commands that drive devices.
#pragma once

#include "devices/falcon/falcon_options.h"

namespace CLI {
class App;
}

namespace tangent {

/// --falcon-serial, --falcon-firmware, --falcon-firmware-sha256, --falcon-torque-scale, --falcon-keep. `falcon` must
/// outlive the parsing.
void add_falcon_options(CLI::App& command, FalconOptions& falcon);

}  // namespace tangent
