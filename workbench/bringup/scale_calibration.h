// What a calibration by a spring scale (force_calibration.h) is made on, and where its result is kept. Looks for
// devices and writes files: not in the servo thread.
#pragma once

#include "core/base/result.h"
#include "devices/device_set.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

struct ScaleCalibration {
  std::unique_ptr<ForceDevice> device;  ///< not yet opened
  double used_scale = 0.0;              ///< counts for 1 N m that it begins with
  bool rehearsal = false;               ///< of a simulated device: nothing is kept
};

/// "falcon", and "simulated" to rehearse it.
const std::vector<std::string_view>& calibrated_names();

/// `kind`: one of calibrated_names(). `kept`: the file of what is kept (falcon_setups.h); its torque scale is not used,
/// as it may be what is wrong: begins with the one in `drivers`, or the uncalibrated one. Fails as
/// make_devices_as_kept does.
Result<ScaleCalibration> scale_calibration(const std::string& kind, DeviceOptions drivers,
                                           const std::filesystem::path& kept);

/// Keeps the scale, in whole counts, by serial number. The result says where, or, where it can't be kept, what to do
/// instead. Fails on a file that can't be read or written.
Result<std::string> keep_scale(const std::filesystem::path& kept, const std::string& serial, double scale);

}  // namespace tangent
