#include "devices/maestro/maestro_codec.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kShortest_us = 400.0, kLongest_us = 2600.0;

}  // namespace

UsbControl maestro_target(std::uint8_t channel, std::uint16_t quarter_us) {
  return {.request = 0x85, .value = quarter_us, .index = channel};
}

// Speed and acceleration share a request; the high bit of the index selects which.
UsbControl maestro_speed(std::uint8_t channel, std::uint16_t speed) {
  return {.request = 0x84, .value = speed, .index = channel};
}

UsbControl maestro_acceleration(std::uint8_t channel, std::uint8_t acceleration) {
  return {.request = 0x84, .value = acceleration, .index = static_cast<std::uint16_t>(channel | 0x80u)};
}

Status check_calibration(const MaestroCalibration& c) {
  const auto bad = [](const std::string& what) {
    return fail(what, "Maestro calibration", "measure two places of the roller and their pulses");
  };
  for (const double v : {c.low_m, c.high_m, c.low_us, c.high_us}) {
    if (!std::isfinite(v)) return bad("a value is not finite");
  }
  if (!(c.low_m < c.high_m)) return bad("the low place is not below the high one");
  if (std::abs(c.low_us - c.high_us) < 1.0) return bad("both places have the same pulse");
  for (const double us : {c.low_us, c.high_us}) {
    if (us < kShortest_us || us > kLongest_us)
      return bad("a pulse of " + std::to_string(us) + " us is outside 400 to 2600 us");
  }
  return {};
}

std::uint16_t quarter_us_at(const MaestroCalibration& c, double position_m) {
  const double share = std::clamp((position_m - c.low_m) / (c.high_m - c.low_m), 0.0, 1.0);
  return static_cast<std::uint16_t>(std::lround(4.0 * (c.low_us + share * (c.high_us - c.low_us))));
}

double position_at(const MaestroCalibration& c, std::uint16_t quarter_us) {
  const double share = (0.25 * quarter_us - c.low_us) / (c.high_us - c.low_us);
  return c.low_m + share * (c.high_m - c.low_m);
}

}  // namespace tangent
