// Calibrations of Pololu Maestros, kept by serial number in the user's configuration folder: a servo's horn stays where it was
// screwed on, so what was measured with a calliper holds until it is taken off.
#pragma once

#include "core/base/result.h"
#include "devices/maestro/maestro_codec.h"

#include <filesystem>
#include <optional>
#include <string>

namespace tangent {

struct MaestroSetup {
  MaestroCalibration calibration;
  unsigned channel = 0;   ///< the servo is on; 0 to 23
  bool operator==(const MaestroSetup&) const = default;
};

inline constexpr const char* kMaestroFile = "maestro.toml";

/// Beside the window's settings; empty when there is no home.
std::filesystem::path maestro_setups_path();

/// Nothing: none is kept for this serial number, or there is no file. Fails on a file that can't be read, an unknown or missing
/// key, and a calibration that can't be, naming the line: pulses that are not meant are worse than none.
Result<std::optional<MaestroSetup>> read_maestro_setup(const std::filesystem::path& path, const std::string& serial);

/// Atomic; makes the folder. The setups of other serial numbers stay. Fails as reading does: nothing that a person wrote there
/// is lost.
Status keep_maestro_setup(const std::filesystem::path& path, const std::string& serial, const MaestroSetup& setup);

/// Serial number of the first Maestro that is attached; empty: there is none, or it can't be opened.
std::string attached_maestro();

/// What to drive the attached Maestro with: `given` where it is not the program's own, else what is kept, else the program's own.
Result<MaestroSetup> chosen_maestro_setup(const MaestroSetup& given, const std::filesystem::path& path);

}  // namespace tangent
