// Serial ports that are attached, and which of them is meant. Reads folders: not in the servo thread.
#pragma once

#include "core/base/result.h"
#include "devices/found_device.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tangent {

struct SerialPortInfo {
  std::string path;    ///< "/dev/ttyACM0"
  std::string by_id;   ///< "/dev/serial/by-id/usb-Hapkit_77-if00", the same wherever it is plugged in; empty: none
  std::string serial;  ///< out of that name; empty: none
};

/// ttyACM* (USB CDC) and ttyUSB* (converters), sorted. `dev`: another folder for tests.
std::vector<SerialPortInfo> list_serial_ports(const std::filesystem::path& dev = "/dev");

/// The one at `wanted`, a path; when empty, the only one there is. Fails with what to do when there is none, and with a
/// list of them when there are several.
Result<SerialPortInfo> choose_serial_port(const std::string& wanted, const std::filesystem::path& dev = "/dev");

/// Each of them, for `workbench devices`: what is on it is known when it is opened, which resets some boards; here it
/// is only looked whether one may.
std::vector<FoundDevice> find_serial_devices(const std::filesystem::path& dev = "/dev");

}  // namespace tangent
