// Counts of the Falcon's torque command for a newton metre. No source that we found says it, so it is measured, device
// by device, with a spring scale; until then a low value and a low limit are used.
#pragma once

#include "core/base/result.h"

#include <span>

namespace tangent {

/// Half of the 10,000 that a public driver (libnifalcon) uses, which nobody says was measured: too low a value pushes
/// too little.
inline constexpr double kFalconUncalibratedScale = 5000.0;
inline constexpr double kFalconLeastScale = 500.0, kFalconMostScale = 100'000.0;

/// One reading: the force that was asked for, pulled straight out along the device's axis, and what the scale showed.
struct FalconReading {
  double asked_n = 0.0, read_n = 0.0;
};

/// The scale with which readings would have been what was asked for: used / slope, by least squares through 0. Fails
/// on fewer than three readings, values that are not finite and above 0, asked forces that are all alike, readings more
/// than 15 % of the largest off the line, and a result out of range.
Result<double> torque_scale_from(std::span<const FalconReading> readings, double used_scale);

struct FalconScaleStep {
  const char* title;  ///< "Pull with 0.25 N"
  const char* what;   ///< for the person
  double push_n;      ///< outwards, along its axis, in the middle of the workspace; 0: none
  bool reads;         ///< the scale's reading is asked for
};
/// What the person does, in order. Before each force the person says yes.
std::span<const FalconScaleStep> falcon_scale_steps();

}  // namespace tangent
