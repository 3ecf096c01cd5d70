#include "devices/gate/limits.h"

#include "devices/contact_display.h"
#include "devices/force_device.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

namespace tangent {

namespace {

struct NamedValue {
  const char* name;
  double value;
  bool may_be_zero = true;
};

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

constexpr const char* kRemedy = "the driver reports this wrongly; it is not used with a hand until that is corrected";

Status check_values(const std::string& where, std::initializer_list<NamedValue> values) {
  for (const NamedValue& v : values) {
    if (!std::isfinite(v.value)) return fail(std::string(v.name) + " is not a finite number", where, kRemedy);
    if (v.value < 0.0) return fail(std::string(v.name) + " is negative: " + shown(v.value), where, kRemedy);
    if (v.value == 0.0 && !v.may_be_zero) return fail(std::string(v.name) + " is zero", where, kRemedy);
  }
  return {};
}

Status check_forces(const std::string& where, double peak_n, double continuous_n) {
  if (continuous_n <= peak_n) return {};
  return fail("the continuous force, " + shown(continuous_n) + " N, is above the peak force, " + shown(peak_n) + " N",
              where, kRemedy);
}

Status check_counts(const ForceCapabilities& can) {
  if (can.buttons < 0 || can.buttons > 32)
    return fail("buttons: " + shown(can.buttons) + " is not 0 to 32", can.name, kRemedy);
  const Placement in_world{.rotation = can.frame.rotation, .offset_m = can.frame.origin_m};
  if (check_placement(in_world)) return {};
  return fail("its frame is not a unit quaternion and a finite origin", can.name, kRemedy);
}

}  // namespace

double longest_tick_s(const GateLimits& limits) noexcept {
  constexpr double kRounding = 1.0 + 1e-9;
  return kRounding * std::min(limits.late_periods * limits.period_s, std::max(limits.late_s, 2.0 * limits.period_s));
}

Status check_limits(const GateLimits& l) {
  const std::string where = "safety gate";
  const Status values = check_values(where, {{"peak force", l.peak_force_n},
                                             {"slew rate", l.slew_n_per_s, false},
                                             {"ramp", l.ramp_s},
                                             {"display travel", l.display_travel_m},
                                             {"continuous force", l.continuous_force_n},
                                             {"workspace, x", l.workspace_half_size_m.x},
                                             {"workspace, y", l.workspace_half_size_m.y},
                                             {"workspace, z", l.workspace_half_size_m.z},
                                             {"workspace margin", l.workspace_margin_m},
                                             {"fastest finger", l.fastest_m_per_s, false},
                                             {"fastest roller", l.fastest_display_m_per_s, false},
                                             {"oldest sample", l.stale_s, false},
                                             {"longest tick", l.late_s, false},
                                             {"longest tick in periods", l.late_periods, false},
                                             {"period", l.period_s, false},
                                             {"sample time", l.sample_s, false},
                                             {"display's sample time", l.display_sample_s, false},
                                             {"resolution", l.resolution_m},
                                             {"fastest target", l.fastest_target_m_per_s, false}});
  return values ? check_forces(where, l.peak_force_n, l.continuous_force_n) : values;
}

Status check_capabilities(const ForceCapabilities& can) {
  const Status values = check_values(can.name, {{"peak force", can.peak_force_n},
                                                {"continuous force", can.continuous_force_n},
                                                {"position resolution", can.position_resolution_m},
                                                {"apparent mass", can.apparent_mass_kg},
                                                {"largest stiffness", can.largest_stiffness_n_per_m},
                                                {"largest damping", can.largest_damping_n_s_per_m},
                                                {"workspace, x", can.workspace_half_size_m.x},
                                                {"workspace, y", can.workspace_half_size_m.y},
                                                {"workspace, z", can.workspace_half_size_m.z},
                                                {"rate", can.rate_hz},
                                                {"homing time", can.homing_s},
                                                {"firmware time-out", can.firmware_timeout_s}});
  if (!values) return values;
  if (const Status counts = check_counts(can); !counts) return counts;
  return check_forces(can.name, can.peak_force_n, can.continuous_force_n);
}

Status check_capabilities(const DisplayCapabilities& can) {
  return check_values(can.name, {{"travel", can.travel_m},
                                 {"resolution", can.resolution_m},
                                 {"bandwidth", can.bandwidth_hz},
                                 {"rate", can.rate_hz},
                                 {"fastest target", can.fastest_m_per_s},
                                 {"homing time", can.homing_s},
                                 {"firmware time-out", can.firmware_timeout_s}});
}

}  // namespace tangent
