// Options of the serial force device.
#pragma once

namespace CLI {
class App;
}

namespace tangent {

struct SerialForceOptions;

/// --serial-port, --serial-baud. `options` must outlive the parsing.
void add_serial_options(CLI::App& command, SerialForceOptions& options);

}  // namespace tangent
