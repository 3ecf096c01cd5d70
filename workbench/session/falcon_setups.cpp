#include "workbench/session/falcon_setups.h"

#include "core/io/atomic_file.h"
#include "core/io/file_format.h"
#include "core/io/toml_file.h"
#include "core/preset/schema.h"
#include "devices/falcon/falcon_calibration.h"
#include "workbench/session/file_lock.h"
#include "workbench/session/window_settings.h"

#include <array>
#include <sstream>
#include <system_error>

namespace tangent {
namespace {

constexpr std::size_t kMostFalconBytes = std::size_t{1} << 20;
constexpr std::array<MigrationStep, 1> kFalconSteps{only_number};
constexpr FileFormats kFalconFormats{"calibration", kFalconSteps};
constexpr std::array<std::string_view, 3> kFalconKeys{"torque_counts_per_nm", "firmware", "firmware_sha256"};
constexpr const char* kFalconRemedy = "correct it, or delete the file and calibrate again";

std::string falcon_place(const std::filesystem::path& path, const toml::node& node, const std::string& what) {
  return path.string() + ":" + std::to_string(node.source().begin.line) + " " + what;
}

Result<FalconSetup> falcon_setup_of(const std::filesystem::path& path, const std::string& serial,
                                    const toml::table& table) {
  FalconSetup setup;
  for (const auto& [key, node] : table) {
    const std::string place = falcon_place(path, node, serial + "." + std::string(key.str()));
    if (key.str() == kFalconKeys[0]) {
      if (!node.is_number()) return fail("is not a number", place, kFalconRemedy);
      setup.torque_counts_per_nm = *node.value<double>();
      if (!(setup.torque_counts_per_nm >= kFalconLeastScale && setup.torque_counts_per_nm <= kFalconMostScale))
        return fail("is no torque scale", place, "allowed: 500 to 100000");
      continue;
    }
    if (key.str() != kFalconKeys[1] && key.str() != kFalconKeys[2])
      return fail("unknown key", place, "allowed: " + choices_text(kFalconKeys));
    if (!node.is_string()) return fail("is not a text", place, kFalconRemedy);
    (key.str() == kFalconKeys[1] ? setup.firmware : setup.firmware_sha256) = *node.value<std::string>();
  }
  return setup;
}

Result<FalconSetups> read_falcon_setups(const std::filesystem::path& path) {
  FalconSetups setups;
  auto root = read_settings_file(path, kMostFalconBytes, kFalconRemedy);
  if (!root) return tl::unexpected(root.error());
  if (const Status status = migrate(*root, kFalconFormats, path.string()); !status)
    return tl::unexpected(status.error());
  for (const auto& [key, node] : *root) {
    const std::string serial(key.str());
    if (!node.is_table())
      return fail("is not a table", falcon_place(path, node, serial), "write a table for each serial number");
    auto setup = falcon_setup_of(path, serial, *node.as_table());
    if (!setup) return tl::unexpected(setup.error());
    setups[serial] = *setup;
  }
  return setups;
}

std::string format_falcon_setups(const FalconSetups& setups) {
  toml::table root;
  for (const auto& [serial, setup] : setups) {
    toml::table table;
    if (setup.torque_counts_per_nm > 0.0) table.insert(kFalconKeys[0], setup.torque_counts_per_nm);
    if (!setup.firmware.empty()) table.insert(kFalconKeys[1], setup.firmware);
    if (!setup.firmware_sha256.empty()) table.insert(kFalconKeys[2], setup.firmware_sha256);
    root.insert(serial, std::move(table));
  }
  std::ostringstream text;
  text << "# Novint Falcons by serial number: torque scale in counts for 1 N m, and their firmware.\n"
       << kFalconFormats.line() << root << "\n";
  return text.str();
}

/// Of the only Falcon that is attached and can be opened; empty when there is none, or several.
std::string attached_falcon() {
  const UsbLinkOptions link = falcon_link_options();
  const auto found = list_usb_devices(link.match, link.interface_number);
  return found && found->size() == 1 ? found->front().serial : std::string();
}

}  // namespace

std::filesystem::path falcon_setups_path() {
  const std::filesystem::path window = window_settings_path();
  return window.empty() ? window : window.parent_path() / kFalconFile;
}

Result<std::optional<FalconSetup>> read_falcon_setup(const std::filesystem::path& path, const std::string& serial) {
  const auto setups = read_falcon_setups(path);
  if (!setups) return tl::unexpected(setups.error());
  const auto found = setups->find(serial);
  if (found == setups->end()) return std::optional<FalconSetup>();
  return std::optional<FalconSetup>(found->second);
}

Status keep_falcon_setup(const std::filesystem::path& path, const std::string& serial, const FalconSetup& setup) {
  if (serial.empty() || serial == kFormatKey)
    return fail("no serial number to keep it by", "Novint Falcon", "give the values as options each time");
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  const FileLock lock(path);  // another program may calibrate another Falcon
  if (!lock.held())
    return fail("another program holds its lock, or none can be made", path.string(), "close the other program");
  auto setups = read_falcon_setups(path);
  if (!setups) return tl::unexpected(setups.error());
  (*setups)[serial] = setup;
  return write_file_atomic(path, format_falcon_setups(*setups));
}

Status keep_falcon_scale(const std::filesystem::path& path, const std::string& serial, double counts_per_nm) {
  const auto kept = read_falcon_setup(path, serial);
  if (!kept) return tl::unexpected(kept.error());
  FalconSetup setup = kept->value_or(FalconSetup{});
  setup.torque_counts_per_nm = counts_per_nm;
  return keep_falcon_setup(path, serial, setup);
}

Result<FalconOptions> chosen_falcon_options(FalconOptions given, const std::filesystem::path& path) {
  const std::string serial = given.serial.empty() ? attached_falcon() : given.serial;
  if (serial.empty() && !path.empty() && !given.keep) {
    auto kept = read_falcon_setups(path);
    if (!kept) return tl::unexpected(kept.error());
    given.kept = std::move(*kept);
  }
  if (serial.empty() || path.empty()) {
    if (!given.keep) return given;
    return fail("no Falcon with a serial number is attached, or there is no home directory", "--falcon-keep",
                "attach it, or give the values as options each time");
  }
  const auto kept = read_falcon_setup(path, serial);
  if (!kept) return tl::unexpected(kept.error());
  FalconSetup setup = kept->value_or(FalconSetup{});
  if (given.torque_counts_per_nm > 0.0) setup.torque_counts_per_nm = given.torque_counts_per_nm;
  if (!given.firmware.empty()) {
    setup.firmware = std::filesystem::absolute(given.firmware).string();
    setup.firmware_sha256 = given.firmware_sha256;
  } else if (!given.firmware_sha256.empty()) {
    setup.firmware_sha256 = given.firmware_sha256;
  }
  if (given.keep) {
    if (const Status status = keep_falcon_setup(path, serial, setup); !status) return tl::unexpected(status.error());
  }
  given.serial = serial;
  given.torque_counts_per_nm = setup.torque_counts_per_nm;
  given.firmware = setup.firmware;
  given.firmware_sha256 = setup.firmware_sha256;
  return given;
}

}  // namespace tangent
