// The safety gate's limits, and the checks of what they come from: a device that says nonsense is not opened. SI units.
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"

#include <array>

namespace tangent {

struct ForceCapabilities;
struct DisplayCapabilities;

struct GateLimits {
  double peak_force_n = 0.0;        ///< of the device; 0: no force at all
  double slew_n_per_s = 2000.0;     ///< fastest change of the force; does not delay the drop to zero of a stop or fault
  double ramp_s = 0.25;             ///< from arming to full force
  double display_travel_m = 0.0;    ///< end to end
  double continuous_force_n = 0.0;  ///< of the device; 0: not known, no limit
  std::array<bool, 3> pushes_along{true, true, true};  ///< axes along which the device can push
  Vec3 workspace_half_size_m{0.0};                     ///< box around the device's origin; 0: no limit along that axis
  double workspace_margin_m = 5e-3;                    ///< beyond the box, over which the force fades out
  double fastest_m_per_s = 10.0;                       ///< of the finger; a fast hand moves at 2 to 3
  double fastest_display_m_per_s = 1.0;                ///< of the roller; a drive reaches 0.2
  double stale_s = 10e-3;                              ///< oldest sample that may produce a force
  double late_s = 20e-3;                               ///< longest tick, see longest_tick_s
  double late_periods = 20.0;                          ///< the same in periods of the servo
  double period_s = 1e-3;          ///< of the servo: force and target change by no more than this allows in a tick
  double sample_s = 1e-3;          ///< between two samples of the force device
  double display_sample_s = 1e-3;  ///< and of the display
  double resolution_m = 0.0;       ///< of the force device's position
  double fastest_target_m_per_s = 0.25;  ///< of the display's target
};

/// Longest tick that is no fault, s: late_periods, and no more than late_s; a single missed deadline is allowed at
/// every rate.
double longest_tick_s(const GateLimits& limits) noexcept;

/// Each fails on a value that is not finite, negative, or out of order (a continuous force above the peak), and names
/// it. 0 remains "not known" where the field says so.
Status check_limits(const GateLimits& limits);
Status check_capabilities(const ForceCapabilities& can);
Status check_capabilities(const DisplayCapabilities& can);

}  // namespace tangent
