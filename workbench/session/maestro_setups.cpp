#include "workbench/session/maestro_setups.h"

#include "core/io/atomic_file.h"
#include "core/io/file_format.h"
#include "core/io/toml_file.h"
#include "core/preset/schema.h"
#include "devices/maestro/maestro_display.h"
#include "workbench/session/file_lock.h"
#include "workbench/session/window_settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <system_error>

namespace tangent {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::array<MigrationStep, 1> kSteps{only_number};
constexpr FileFormats kFormats{"calibration", kSteps};
constexpr double kMostChannel = 23.0;
constexpr std::array<std::string_view, 5> kKeys{"channel", "low_m", "low_us", "high_m", "high_us"};
constexpr const char* kRemedy = "correct it, or delete the file and calibrate again";

using Setups = std::map<std::string, MaestroSetup>;  // by serial number

std::string where(const std::filesystem::path& path, const toml::node& node, const std::string& what) {
  return path.string() + ":" + std::to_string(node.source().begin.line) + " " + what;
}

Result<MaestroSetup> read_setup(const std::filesystem::path& path, const std::string& serial,
                                const toml::table& table) {
  MaestroSetup setup;
  double channel = 0.0;
  const std::array<double*, kKeys.size()> fields{&channel, &setup.calibration.low_m, &setup.calibration.low_us,
                                                 &setup.calibration.high_m, &setup.calibration.high_us};
  for (const auto& [key, node] : table) {
    const auto known = std::find(kKeys.begin(), kKeys.end(), key.str());
    const std::string place = where(path, node, serial + "." + std::string(key.str()));
    if (known == kKeys.end()) return fail("unknown key", place, "allowed: " + choices_text(kKeys));
    if (!node.is_number()) return fail("is not a number", place, kRemedy);
    *fields[static_cast<std::size_t>(known - kKeys.begin())] = *node.value<double>();
  }
  if (table.size() != kKeys.size())
    return fail("a key is missing", where(path, table, serial), "it needs " + choices_text(kKeys));
  if (!(channel >= 0.0 && channel <= kMostChannel) || channel != std::floor(channel))
    return fail("is not a channel", where(path, table, serial + ".channel"), "allowed: 0 to 23");
  if (const Status sound = check_calibration(setup.calibration); !sound)
    return fail(sound.error().what, where(path, table, serial), kRemedy);
  setup.channel = static_cast<unsigned>(channel);
  return setup;
}

Result<Setups> read_setups(const std::filesystem::path& path) {
  Setups setups;
  auto root = read_settings_file(path, kMaxBytes, kRemedy);
  if (!root) return tl::unexpected(root.error());
  if (const Status status = migrate(*root, kFormats, path.string()); !status) return tl::unexpected(status.error());
  for (const auto& [key, node] : *root) {
    const std::string serial(key.str());
    if (!node.is_table())
      return fail("is not a table", where(path, node, serial), "write a table for each serial number");
    auto setup = read_setup(path, serial, *node.as_table());
    if (!setup) return tl::unexpected(setup.error());
    setups[serial] = *setup;
  }
  return setups;
}

std::string format_setups(const Setups& setups) {
  toml::table root;
  for (const auto& [serial, setup] : setups) {
    const MaestroCalibration& c = setup.calibration;
    root.insert(serial, toml::table{{"channel", static_cast<std::int64_t>(setup.channel)},
                                    {"low_m", c.low_m},
                                    {"low_us", c.low_us},
                                    {"high_m", c.high_m},
                                    {"high_us", c.high_us}});
  }
  std::ostringstream text;
  text << "# Pololu Maestros by serial number: two places of the roller and the pulses that hold it there.\n"
       << kFormats.line() << root << "\n";
  return text.str();
}

}  // namespace

MaestroSetup MaestroWish::over(MaestroSetup setup) const {
  setup.calibration.low_m = low_m.value_or(setup.calibration.low_m);
  setup.calibration.low_us = low_us.value_or(setup.calibration.low_us);
  setup.calibration.high_m = high_m.value_or(setup.calibration.high_m);
  setup.calibration.high_us = high_us.value_or(setup.calibration.high_us);
  setup.channel = channel.value_or(setup.channel);
  return setup;
}

MaestroWish wish_for(const MaestroSetup& setup) {
  const MaestroCalibration& c = setup.calibration;
  return {c.low_m, c.low_us, c.high_m, c.high_us, setup.channel};
}

std::filesystem::path maestro_setups_path() {
  const std::filesystem::path window = window_settings_path();
  return window.empty() ? window : window.parent_path() / kMaestroFile;
}

Result<std::optional<MaestroSetup>> read_maestro_setup(const std::filesystem::path& path, const std::string& serial) {
  const auto setups = read_setups(path);
  if (!setups) return tl::unexpected(setups.error());
  const auto found = setups->find(serial);
  if (found == setups->end()) return std::optional<MaestroSetup>();
  return std::optional<MaestroSetup>(found->second);
}

Status keep_maestro_setup(const std::filesystem::path& path, const std::string& serial, const MaestroSetup& setup) {
  if (serial == kFormatKey) return fail("no serial number", serial, "give the Maestro another one");
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  const FileLock lock(path);  // another program may calibrate another Maestro
  if (!lock.held())
    return fail("another program holds its lock, or none can be made", path.string(), "close the other program");
  auto setups = read_setups(path);
  if (!setups) return tl::unexpected(setups.error());
  (*setups)[serial] = setup;
  return write_file_atomic(path, format_setups(*setups));
}

std::string attached_maestro() {
  const UsbLinkOptions link = maestro_link_options();
  const auto found = list_usb_devices(link.match, link.interface_number);
  if (!found) return {};
  for (const UsbDeviceInfo& device : *found) {
    if (device.problem == UsbProblem::none) return device.serial;
  }
  return {};
}

Result<MaestroSetup> chosen_maestro_setup(const MaestroWish& wish, const std::filesystem::path& path) {
  const std::string serial = wish.complete() || path.empty() ? std::string() : attached_maestro();
  if (serial.empty()) return wish.over({});
  const auto kept = read_maestro_setup(path, serial);
  if (!kept) return tl::unexpected(kept.error());
  return wish.over(kept->value_or(MaestroSetup{}));
}

}  // namespace tangent
