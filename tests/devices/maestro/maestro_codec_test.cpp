#include "devices/maestro/maestro_codec.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace tangent;

TEST_CASE("Maestro requests are the vendor's") {
  const UsbControl target = maestro_target(2, 6000);
  CHECK(target.request_type == 0x40);
  CHECK(target.request == 0x85);
  CHECK(target.value == 6000);
  CHECK(target.index == 2);
  CHECK(maestro_speed(3, 140).request == 0x84);
  CHECK(maestro_speed(3, 140).value == 140);
  CHECK(maestro_speed(3, 140).index == 3);
  CHECK(maestro_acceleration(3, 4).request == 0x84);
  CHECK(maestro_acceleration(3, 4).index == 0x83);
}

TEST_CASE("places and pulses map onto each other through the two calibrated ones, either way round") {
  for (const bool reversed : {false, true}) {
    const MaestroCalibration c{
        .low_m = -8e-3, .low_us = reversed ? 1900.0 : 1100.0, .high_m = 9e-3, .high_us = reversed ? 1100.0 : 1900.0};
    REQUIRE(check_calibration(c));
    CHECK(quarter_us_at(c, -8e-3) == 4 * c.low_us);
    CHECK(quarter_us_at(c, 9e-3) == 4 * c.high_us);
    CHECK(quarter_us_at(c, 1.0) == 4 * c.high_us);  // no further than calibrated
    CHECK(quarter_us_at(c, -1.0) == 4 * c.low_us);
    const double step = 0.25 * 17e-3 / 800.0;
    for (double x = -8e-3; x <= 9e-3; x += 0.31e-3)
      CHECK(std::abs(position_at(c, quarter_us_at(c, x)) - x) <= 0.5 * step + 1e-12);
  }
}

TEST_CASE("calibrations that can't be are refused") {
  const MaestroCalibration good;
  CHECK(check_calibration(good));
  for (const MaestroCalibration& bad :
       {MaestroCalibration{5e-3, 1000, 5e-3, 2000}, MaestroCalibration{-5e-3, 1500, 5e-3, 1500},
        MaestroCalibration{-5e-3, 100, 5e-3, 1500}, MaestroCalibration{-5e-3, 1000, 5e-3, 9000},
        MaestroCalibration{5e-3, 1000, -5e-3, 2000},
        MaestroCalibration{-5e-3, std::numeric_limits<double>::quiet_NaN(), 5e-3, 2000}}) {
    const Status refused = check_calibration(bad);
    REQUIRE_FALSE(refused);
    CHECK_FALSE(refused.error().remedy.empty());
  }
}
