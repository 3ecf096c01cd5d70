// Pololu Maestro servo controllers, as far as they are used here: control transfers and the map from travel to pulse
// width. Pure. Requests as in Pololu's Maestro USB protocol: vendor type, no data; a target is a pulse width in
// quarters of a microsecond, 0 switches the channel off.
#pragma once

#include "core/base/result.h"
#include "devices/usb/usb_link.h"

#include <cstdint>

namespace tangent {

inline constexpr std::uint16_t kMaestroVendor = 0x1FFB;
inline constexpr std::uint16_t kMaestroProducts[]{0x0089, 0x008A, 0x008B, 0x008C};  ///< Micro 6, Mini 12, 18, 24

UsbControl maestro_target(std::uint8_t channel, std::uint16_t quarter_us);
/// 0.25 us / 10 ms; 0: unlimited.
UsbControl maestro_speed(std::uint8_t channel, std::uint16_t speed);
/// 0.25 us / 10 ms / 80 ms; 0: unlimited.
UsbControl maestro_acceleration(std::uint8_t channel, std::uint8_t acceleration);

/// Two places of the roller and the pulses that bring it there.
struct MaestroCalibration {
  double low_m = -10e-3, low_us = 1000.0;
  double high_m = 10e-3, high_us = 2000.0;
  bool operator==(const MaestroCalibration&) const = default;
};

/// Fails when the places or the pulses are the same, not finite, or outside what a servo takes (400 to 2600 us).
Status check_calibration(const MaestroCalibration& calibration);
/// Pulse for a place, clamped to between the two pulses. Precondition: a checked calibration, finite position.
std::uint16_t quarter_us_at(const MaestroCalibration& calibration, double position_m);
/// The place that a pulse stands for.
double position_at(const MaestroCalibration& calibration, std::uint16_t quarter_us);

}  // namespace tangent
