#include "workbench/recording/recorded_values.h"

#include "devices/contact_display.h"
#include "devices/force_device.h"

namespace tangent {

std::vector<RecordedValue> recorded_values(const ForceCapabilities& can) {
  const auto value = [](const char* name, double v) { return RecordedValue{"force", name, v}; };
  return {{"force", "name", can.name},
          {"force", "serial", can.serial},
          value("simulated", can.simulated ? 1.0 : 0.0),
          value("peak_force_n", can.peak_force_n),
          value("continuous_force_n", can.continuous_force_n),
          value("position_resolution_m", can.position_resolution_m),
          value("largest_stiffness_n_per_m", can.largest_stiffness_n_per_m),
          value("largest_damping_n_s_per_m", can.largest_damping_n_s_per_m),
          value("workspace_half_x_m", can.workspace_half_size_m.x),
          value("workspace_half_y_m", can.workspace_half_size_m.y),
          value("workspace_half_z_m", can.workspace_half_size_m.z),
          value("rotations_sensed", can.rotations_sensed()),
          value("buttons", can.buttons),
          value("rate_hz", can.rate_hz),
          value("firmware_timeout_s", can.firmware_timeout_s),
          {"force", "frame", frame_text(can.frame)},
          {"force", "pushes_along", pushed_axes(can)}};
}

std::vector<RecordedValue> recorded_values(const DisplayCapabilities& can) {
  const auto value = [](const char* name, double v) { return RecordedValue{"display", name, v}; };
  return {{"display", "name", can.name},
          value("simulated", can.simulated ? 1.0 : 0.0),
          value("travel_m", can.travel_m),
          value("resolution_m", can.resolution_m),
          value("bandwidth_hz", can.bandwidth_hz),
          value("rate_hz", can.rate_hz),
          value("fastest_m_per_s", can.fastest_m_per_s),
          value("measures_position", can.measures_position ? 1.0 : 0.0),
          value("firmware_timeout_s", can.firmware_timeout_s),
          value("has_controller", can.has_controller ? 1.0 : 0.0)};
}

}  // namespace tangent
