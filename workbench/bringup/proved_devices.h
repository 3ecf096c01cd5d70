// What was proved on the devices that were brought up, kept by serial number in the user's configuration folder. All
// calls read or write files: not in the servo thread.
#pragma once

#include "core/base/result.h"
#include "workbench/bringup/bring_up_protocol.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

struct ProvedDevice {
  std::string kind, serial, name, date, program;
  double most_n = 0.0;              ///< largest force that was tried
  bool all = false;                 ///< all steps
  std::vector<std::string> proved;  ///< step_word of each
  bool operator==(const ProvedDevice&) const = default;
};

inline constexpr const char* kProvedFile = "proved-devices.toml";

/// In the folder of the window's settings; empty when there is no home directory.
std::filesystem::path proved_devices_path();

/// Of a protocol.
ProvedDevice proved_device(const BringUpProtocol& protocol);
/// "all proved on 2026-11-23, up to 1.0 N", or which steps.
std::string proved_text(const ProvedDevice& proved);

/// Empty when nothing is kept of it, or there is no file. Fails on a file that can't be read.
Result<std::optional<ProvedDevice>> read_proved(const std::filesystem::path& path, const std::string& kind,
                                                const std::string& serial);
/// In place of what was kept of that device. Writes atomically; makes the folder. Fails where reading fails, and on a
/// device without a serial number: nothing tells it from another.
Status keep_proved(const std::filesystem::path& path, const ProvedDevice& proved);

}  // namespace tangent
