// Options of the force device "haply".
#pragma once

#include "devices/haply/haply_options.h"

namespace CLI {
class App;
}

namespace tangent {

/// --haply-address, --haply-other-host, --haply-events-port, --haply-device, --haply-peak-n, --haply-centre-mm.
/// `options` must outlive the parsing.
void add_haply_options(CLI::App& command, HaplyOptions& options);

}  // namespace tangent
