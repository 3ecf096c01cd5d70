// Calibrations of Pololu Maestros, stored by serial number in the user's configuration folder: they hold as long as the
// servo's horn is not taken off. All calls read or write files: not in the servo thread.
#pragma once

#include "core/base/result.h"
#include "devices/maestro/maestro_codec.h"

#include <filesystem>
#include <optional>
#include <string>

namespace tangent {

struct MaestroSetup {
  MaestroCalibration calibration;
  unsigned channel = 0;  ///< of the servo, 0 to 23
  bool operator==(const MaestroSetup&) const = default;
};

/// A person's request. A value left out is taken from the stored setup, or else from the defaults.
struct MaestroWish {
  std::optional<double> low_m, low_us, high_m, high_us;
  std::optional<unsigned> channel;
  bool complete() const { return low_m && low_us && high_m && high_us && channel; }
  /// `setup` with the requested values in place of its own.
  MaestroSetup over(MaestroSetup setup) const;
};
/// A request that states every value of `setup`.
MaestroWish wish_for(const MaestroSetup& setup);

inline constexpr const char* kMaestroFile = "maestro.toml";

/// In the folder of the window's settings; empty when there is no home directory.
std::filesystem::path maestro_setups_path();

/// Empty when no setup is stored for this serial number, or there is no file. Fails on an unreadable file, an unknown
/// or missing key, and an invalid calibration, naming the line: a wrong pulse width is worse than none.
Result<std::optional<MaestroSetup>> read_maestro_setup(const std::filesystem::path& path, const std::string& serial);

/// Writes atomically; makes the folder. Keeps the setups of other serial numbers. Fails where reading fails, so that a
/// file with an error in it is not overwritten, and when the file can't be written.
Status keep_maestro_setup(const std::filesystem::path& path, const std::string& serial, const MaestroSetup& setup);

/// Serial number of the first attached Maestro; empty when there is none or it can't be opened.
std::string attached_maestro();

/// Setup for the attached Maestro: requested values, else those stored for it, else the defaults. Fails when stored
/// values are needed and can't be read.
Result<MaestroSetup> chosen_maestro_setup(const MaestroWish& wish, const std::filesystem::path& path);

}  // namespace tangent
