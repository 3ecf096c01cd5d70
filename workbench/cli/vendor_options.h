// Options of the force devices that are driven through their maker's library.
#pragma once

#include "devices/vendor_options.h"

namespace CLI {
class App;
}

namespace tangent {

/// --hd-library, --hd-device, --hd-reset-encoders, --dhd-library, --dhd-serial, --dhd-peak-n. `options` must outlive
/// the parsing.
void add_vendor_options(CLI::App& command, VendorOptions& options);

}  // namespace tangent
