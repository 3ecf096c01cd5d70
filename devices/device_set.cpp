#include "devices/device_set.h"

#include "devices/simulated_contact_display.h"
#include "devices/simulated_force_device.h"

#include <algorithm>

namespace tangent {

const std::vector<std::string>& device_set_names() {
  static const std::vector<std::string> names{"simulated", "ideal", "none"};
  return names;
}

Result<DeviceSet> make_devices(std::string_view name, std::uint64_t seed) {
  const auto& names = device_set_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    return fail("unknown device \"" + std::string(name) + "\"", "--device", "choose simulated, ideal or none");
  }
  DeviceSet set;
  if (name == "none") return set;
  SimulatedForceOptions force;
  SimulatedDisplayOptions display;
  force.seed = seed;
  if (name == "ideal") {
    force.position_step_m = force.tremor_m = 0.0;
    display.step_m = 0.0;
  }
  set.force = std::make_unique<SimulatedForceDevice>(force);
  set.display = std::make_unique<SimulatedContactDisplay>(display);
  return set;
}

}  // namespace tangent
