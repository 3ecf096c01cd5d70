#include "devices/falcon/falcon_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tangent {

namespace {

constexpr const char* kWhere = "torque scale of the Falcon";

constexpr std::array<FalconScaleStep, 7> kScaleSteps{
    {{"Hook the scale to the grip",
      "Lay the Falcon on its back, so that its grip points up, and hook the spring scale to the grip.", 0.0, false},
     {"Set the scale to 0",
      "Hold the grip in the middle of the workspace by the scale alone, and set the scale to 0 there.", 0.0, false},
     {"Pull with 0.25 N",
      "It pulls away from you, into the Falcon, with about 0.25 N. Hold the grip in the middle and read the scale.",
      -0.25, true},
     {"Pull with 0.5 N", "The same with about 0.5 N.", -0.5, true},
     {"Pull with 0.75 N", "The same with about 0.75 N.", -0.75, true},
     {"Pull with 1 N", "The same with about 1 N.", -1.0, true},
     {"Unhook the scale", "Unhook the scale. The Falcon may be moved by hand again.", 0.0, false}}};

}  // namespace

std::span<const FalconScaleStep> falcon_scale_steps() { return kScaleSteps; }

Result<double> torque_scale_from(std::span<const FalconReading> readings, double used_scale) {
  constexpr double kOffTheLine = 0.15;
  if (readings.size() < 3) return fail("it needs three readings or more", kWhere, "read the scale at more forces");
  if (!(used_scale >= kFalconLeastScale && used_scale <= kFalconMostScale))
    return fail("the scale in use is out of range", kWhere, "begin with the uncalibrated one");
  double asked2 = 0.0, both = 0.0, least = INFINITY, most = 0.0, most_read = 0.0;
  for (const FalconReading& r : readings) {
    if (!(r.asked_n > 0.0 && r.read_n > 0.0 && std::isfinite(r.asked_n) && std::isfinite(r.read_n)))
      return fail("a reading is not a force above 0", kWhere, "read it again, or leave it out");
    asked2 += r.asked_n * r.asked_n;
    both += r.asked_n * r.read_n;
    least = std::min(least, r.asked_n);
    most = std::max(most, r.asked_n);
    most_read = std::max(most_read, r.read_n);
  }
  if (most < 1.5 * least)
    return fail("the forces are all alike", kWhere, "ask for forces of which the largest is twice the least");
  const double slope = both / asked2;
  for (const FalconReading& r : readings)
    if (std::abs(r.read_n - slope * r.asked_n) > kOffTheLine * most_read)
      return fail("the readings are on no line through 0", kWhere, "set the empty scale to 0, hold still, read again");
  const double scale = used_scale / slope;
  if (!(scale >= kFalconLeastScale && scale <= kFalconMostScale))
    return fail("the result, " + std::to_string(scale) + " counts for 1 N m, can't be", kWhere,
                "check that the scale shows newtons, and the power supply of the Falcon");
  return scale;
}

}  // namespace tangent
