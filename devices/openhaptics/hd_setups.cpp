#include "devices/openhaptics/hd_setups.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace tangent::hd {

namespace {

std::vector<std::filesystem::path> setup_folders(const HdOptions& options) {
  if (!options.configs.empty()) return {options.configs};
  std::vector<std::filesystem::path> folders;
  if (const char* home = std::getenv("GTDD_HOME"); home != nullptr) folders.emplace_back(std::string(home) + "/config");
  folders.emplace_back("/usr/share/3DSystems/config");
  if (const char* home = std::getenv("HOME"); home != nullptr)
    folders.emplace_back(std::string(home) + "/.3dsystems/config");
  return folders;
}

}  // namespace

std::vector<std::string> set_up_devices(const HdOptions& options) {
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : setup_folders(options)) {
    std::error_code failed;
    for (const auto& file : std::filesystem::directory_iterator(folder, failed))
      if (file.path().extension() == ".config") names.push_back(file.path().stem().string());
    if (!failed) break;
  }
  std::sort(names.begin(), names.end());
  return names;
}

Result<std::vector<std::string>> find_set_up(const HdOptions& options) {
  if (const auto api = load(options.library); !api) return tl::unexpected(api.error());
  std::vector<std::string> names = set_up_devices(options);
  if (names.empty())
    return fail("its library is there, and no device is set up", "OpenHaptics",
                "set one up with the maker's program (Touch_Setup), or name it by --hd-device");
  return names;
}

Status check_choice(const HdOptions& options) {
  const std::vector<std::string> names = set_up_devices(options);
  if (!options.device.empty() || names.size() < 2) return {};
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "\"" : ", \"") + name + "\"";
  return fail("several are set up: " + list, "OpenHaptics", "choose one: --hd-device NAME");
}

Error calibration_needed(Enum style, const std::string& device) {
  const char* how = style == kInkwell        ? "put the stylus into the inkwell, for a second"
                    : style == kAuto         ? "move the handle around its workspace"
                    : style == kEncoderReset ? "hold it with every link at a right angle to the next, and start again "
                                               "with --hd-reset-encoders"
                                             : "calibrate it with the maker's setup program (Touch_Setup)";
  return {"is not calibrated", device, how};
}

}  // namespace tangent::hd
