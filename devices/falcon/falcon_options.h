// What is chosen about a Falcon, and what is kept of it by its serial number.
#pragma once

#include "devices/falcon/falcon_line.h"
#include "devices/usb/usb_link.h"

#include <filesystem>
#include <map>
#include <string>

namespace tangent {

/// 0403:cb48, interface 0, OUT 0x02, IN 0x81, bulk.
UsbLinkOptions falcon_link_options();

/// What is kept of one Falcon.
struct FalconSetup {
  double torque_counts_per_nm = 0.0;  ///< 0: not calibrated
  std::string firmware;               ///< a path; empty: none
  std::string firmware_sha256;        ///< of a file that our list doesn't have, confirmed by the owner
  bool operator==(const FalconSetup&) const = default;
};
using FalconSetups = std::map<std::string, FalconSetup>;  ///< by serial number

struct FalconOptions {
  std::string serial;               ///< empty: the only one that is attached
  std::filesystem::path firmware;   ///< empty: only a device that runs its firmware already can be used
  std::string firmware_sha256;      ///< confirmed by the owner (falcon_firmware.h)
  double torque_counts_per_nm = 0;  ///< measured on this device (falcon_calibration.h); 0: not calibrated
  bool keep = false;                ///< what is given here is kept by the serial number (workbench/session)
  FalconSetups kept{};              ///< for what is not given here, of whichever Falcon is plugged in
  double silence_s = 10e-3;         ///< no answer for this long: fault `disconnected`
  FalconLineOptions line{};
  UsbLinkOptions link = falcon_link_options();
  UsbTap* tap = nullptr;
};

}  // namespace tangent
