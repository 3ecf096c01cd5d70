// Calibrations of Pololu Maestros, kept by serial number in the user's configuration folder: a servo's horn stays where
// it was screwed on, so what was measured with a calliper holds until it is taken off.
#pragma once

#include "core/base/result.h"
#include "devices/maestro/maestro_codec.h"

#include <filesystem>
#include <optional>
#include <string>

namespace tangent {

struct MaestroSetup {
  MaestroCalibration calibration;
  unsigned channel = 0;  ///< the servo is on; 0 to 23
  bool operator==(const MaestroSetup&) const = default;
};

/// What a person asks for. What is left out stays what is kept for the Maestro, or else the program's own.
struct MaestroWish {
  std::optional<double> low_m, low_us, high_m, high_us;
  std::optional<unsigned> channel;
  bool complete() const { return low_m && low_us && high_m && high_us && channel; }
  MaestroSetup over(MaestroSetup setup) const;
};
/// All of it.
MaestroWish wish_for(const MaestroSetup& setup);

inline constexpr const char* kMaestroFile = "maestro.toml";

/// Beside the window's settings; empty when there is no home.
std::filesystem::path maestro_setups_path();

/// Nothing: none is kept for this serial number, or there is no file. Fails on a file that can't be read, an unknown or
/// missing key, and a calibration that can't be, naming the line: pulses that are not meant are worse than none.
Result<std::optional<MaestroSetup>> read_maestro_setup(const std::filesystem::path& path, const std::string& serial);

/// Atomic; makes the folder. The setups of other serial numbers stay. Fails as reading does: nothing that a person
/// wrote there is lost.
Status keep_maestro_setup(const std::filesystem::path& path, const std::string& serial, const MaestroSetup& setup);

/// Serial number of the first Maestro that is attached; empty: there is none, or it can't be opened.
std::string attached_maestro();

/// What to drive the attached Maestro with: what is asked for, else what is kept for it, else the program's own. Fails
/// where what is kept is needed and can't be read.
Result<MaestroSetup> chosen_maestro_setup(const MaestroWish& wish, const std::filesystem::path& path);

}  // namespace tangent
