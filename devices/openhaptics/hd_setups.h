// Which device is meant, and how a person calibrates it.
//
// HDAPI opens a device by the name it has in the maker's setup program, and can't list the names. The driver keeps a
// file for each in $GTDD_HOME/config, /usr/share/3DSystems/config or ~/.3dsystems/config (its own installation guides);
// that a file is called as its device is what we take it to be, and a person's --hd-device is always believed instead.
#pragma once

#include "core/base/result.h"
#include "devices/openhaptics/hd_api.h"
#include "devices/vendor_options.h"

#include <string>
#include <vector>

namespace tangent::hd {

/// Names of the files in the first of the folders that exists; sorted. Empty when there is none.
std::vector<std::string> set_up_devices(const HdOptions& options);

/// The same, where the library is installed: it is loaded, and nothing is opened. Fails without it, or when nothing is
/// set up.
Result<std::vector<std::string>> find_set_up(const HdOptions& options);

/// Fails, and lists them, when two or more are set up and none was chosen.
Status check_choice(const HdOptions& options);

/// What a person does to calibrate it: "put the stylus into the inkwell".
Error calibration_needed(Enum style, const std::string& device);

}  // namespace tangent::hd
