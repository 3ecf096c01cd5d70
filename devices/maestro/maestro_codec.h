// Pololu Maestro servo controllers: the control transfers that this program uses, and the map from roller position to
// pulse width. Pure functions. Source: Pololu's Maestro USB protocol: vendor requests without data; a target is a
// pulse width in quarter microseconds, 0 switches the channel off.
#pragma once

#include "core/base/result.h"
#include "devices/usb/usb_link.h"

#include <cstdint>

namespace tangent {

inline constexpr std::uint16_t kMaestroVendor = 0x1FFB;
inline constexpr std::uint16_t kMaestroProducts[]{0x0089, 0x008A, 0x008B, 0x008C};  ///< Micro 6, Mini 12, 18, 24

/// Sets a channel's pulse width in quarter microseconds; 0: off.
UsbControl maestro_target(std::uint8_t channel, std::uint16_t quarter_us);
/// `speed` in 0.25 us per 10 ms; 0: unlimited.
UsbControl maestro_speed(std::uint8_t channel, std::uint16_t speed);
/// `acceleration` in 0.25 us per 10 ms per 80 ms; 0: unlimited.
UsbControl maestro_acceleration(std::uint8_t channel, std::uint8_t acceleration);

/// Two roller positions and the pulse widths that move it there; linear in between.
struct MaestroCalibration {
  double low_m = -10e-3, low_us = 1000.0;
  double high_m = 10e-3, high_us = 2000.0;
  bool operator==(const MaestroCalibration&) const = default;
};

/// Fails when positions or pulse widths are equal, not finite, or outside a servo's range (400 to 2600 us).
Status check_calibration(const MaestroCalibration& calibration);
/// Pulse width for a roller position, clamped to the calibration's two pulse widths. Preconditions: the calibration
/// passed check_calibration, the position is finite.
std::uint16_t quarter_us_at(const MaestroCalibration& calibration, double position_m);
/// The roller position (m) of a pulse width: the inverse of quarter_us_at.
double position_at(const MaestroCalibration& calibration, std::uint16_t quarter_us);

}  // namespace tangent
