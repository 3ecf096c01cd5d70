#include "workbench/bringup/scale_calibration.h"

#include "devices/falcon/falcon_calibration.h"
#include "workbench/session/falcon_setups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent {
namespace {

constexpr std::string_view kCalibratedFalcon = "falcon";

}  // namespace

const std::vector<std::string_view>& calibrated_names() {
  static const std::vector<std::string_view> names{kCalibratedFalcon, "simulated"};
  return names;
}

Result<ScaleCalibration> scale_calibration(const std::string& kind, DeviceOptions drivers,
                                           const std::filesystem::path& kept) {
  if (std::find(calibrated_names().begin(), calibrated_names().end(), kind) == calibrated_names().end())
    return fail("\"" + kind + "\" has no torque scale to be calibrated", "calibration", "choose falcon");
  const bool real = kind == kCalibratedFalcon;
  const double given = drivers.falcon.torque_counts_per_nm;
  if (real) {
    auto falcon = chosen_falcon_options(drivers.falcon, kept);
    if (!falcon) return tl::unexpected(falcon.error());
    drivers.falcon = std::move(*falcon);
    drivers.falcon.torque_counts_per_nm = given;
    for (auto& [serial, setup] : drivers.falcon.kept) setup.torque_counts_per_nm = 0.0;
  }
  auto made = make_devices({kind, "none"}, drivers);
  if (!made) return tl::unexpected(made.error());
  return ScaleCalibration{std::move(made->force), given > 0.0 ? given : kFalconUncalibratedScale, !real};
}

Result<std::string> keep_scale(const std::filesystem::path& kept, const std::string& serial, double scale) {
  const std::string counts = std::to_string(std::lround(scale));
  if (serial.empty() || kept.empty())
    return "No serial number to keep it by: give --falcon-torque-scale " + counts + " each time";
  if (const Status done = keep_falcon_scale(kept, serial, std::round(scale)); !done)
    return tl::unexpected(done.error());
  return kept.string() + ": kept for serial number " + serial;
}

}  // namespace tangent
