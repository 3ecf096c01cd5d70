#include "workbench/cli/vendor_options.h"

#include "workbench/cli/option.h"

namespace tangent {

void add_vendor_options(CLI::App& command, VendorOptions& options) {
  add_text_option(command, "--hd-library", options.hd.library,
                  "OpenHaptics' library (default: libHD.so, where the system finds it)", "libHD.so");
  add_text_option(command, "--hd-device", options.hd.device,
                  "Name of the Touch or PHANToM in its maker's setup program (default: the only one)", "NAME");
  add_flag(command, "--hd-reset-encoders", options.hd.reset_encoders,
           "The PHANToM lies at its reset position now: every link at a right angle to the next");
  add_text_option(command, "--dhd-library", options.dhd.library,
                  "Force Dimension's library (default: libdhd.so or libdrd.so, where the system finds it)",
                  "libdhd.so");
  add_number_option(command, "--dhd-serial", {.min = 0, .max = 65535, .whole = true},
                    "Serial number of the Force Dimension device (default: the only one)",
                    [&options](double v) { options.dhd.serial = static_cast<int>(v); });
  add_number_option(command, "--dhd-peak-n", {.min = 0.1, .max = 50, .unit = "N"},
                    "Its peak force, from its data sheet, where its type is not known (default: none, no force)",
                    [&options](double v) { options.dhd.peak_n = v; });
}

}  // namespace tangent
