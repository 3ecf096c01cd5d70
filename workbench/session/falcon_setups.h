// What is kept of Falcons, by serial number, in the user's configuration folder: the measured torque scale and the
// firmware that the owner named and confirmed. All calls read or write files: not in the servo thread.
#pragma once

#include "core/base/result.h"
#include "devices/falcon/falcon_options.h"

#include <filesystem>
#include <optional>
#include <string>

namespace tangent {

inline constexpr const char* kFalconFile = "falcon.toml";

/// In the folder of the window's settings; empty when there is no home directory.
std::filesystem::path falcon_setups_path();

/// Empty when nothing is kept for this serial number, or there is no file. Fails on an unreadable file, an unknown key
/// and a torque scale out of range, naming the line.
Result<std::optional<FalconSetup>> read_falcon_setup(const std::filesystem::path& path, const std::string& serial);

/// Writes atomically; makes the folder. Keeps the setups of other serial numbers. Fails where reading fails, so that a
/// file with an error in it is not overwritten, and when the file can't be written.
Status keep_falcon_setup(const std::filesystem::path& path, const std::string& serial, const FalconSetup& setup);

/// The same, of the torque scale alone: the firmware that is kept stays.
Status keep_falcon_scale(const std::filesystem::path& path, const std::string& serial, double counts_per_nm);

/// `given`, and for what was not given what is kept for that serial number or, without one, for the only Falcon that is
/// attached; then that one alone is opened. Where none can be told, all that is kept goes along, for the one that is
/// plugged in later. With `given.keep` it is kept. Fails when kept values are needed and can't be read, and when there
/// is no serial number to keep values by.
Result<FalconOptions> chosen_falcon_options(FalconOptions given, const std::filesystem::path& path);

}  // namespace tangent
