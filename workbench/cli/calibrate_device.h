// workbench devices --calibrate NAME: a Falcon's torque scale by a spring scale
// (workbench/bringup/force_calibration.h), at the terminal or by lines of a pipe.
#pragma once

#include "core/base/result.h"
#include "devices/device_set.h"

#include <filesystem>
#include <string>

namespace tangent {

struct DeviceCalibration {
  std::string kind;  ///< one of calibrated_names() (scale_calibration.h); empty: none is calibrated
  DeviceOptions drivers;
  std::filesystem::path packets;  ///< every USB packet is logged there; empty: none is
  bool without_waiting = false;   ///< in simulated time
};

/// The exit code: kDone if a scale was found and, where there is a serial number, kept. Fails on an answer that is
/// none, a stop and a refusal, readings that are on no line, and a file that can't be written; then nothing is kept.
Result<int> calibrate_device(const DeviceCalibration& calibration);

}  // namespace tangent
