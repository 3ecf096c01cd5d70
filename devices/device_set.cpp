#include "devices/device_set.h"

#include "devices/cld/cld_controller.h"
#include "devices/simulated/simulated_contact_display.h"
#include "devices/simulated/simulated_force_device.h"

#include <algorithm>

namespace tangent {

const std::vector<std::string>& device_set_names() {
  static const std::vector<std::string> names{"simulated", "ideal", "cld", "maestro", "none"};
  return names;
}

Result<DeviceSet> make_devices(std::string_view name, const DeviceOptions& options) {
  const auto& names = device_set_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    return fail("unknown device \"" + std::string(name) + "\"", "--device",
                "choose simulated, ideal, cld, maestro or none");
  }
  DeviceSet set;
  if (name == "none") return set;
  SimulatedForceOptions force;
  SimulatedDisplayOptions display;
  force.seed = display.seed = options.seed;
  if (name == "ideal") {
    force.position_step_m = force.tremor_m = force.friction_n = 0.0;
    display.mechanism.step_m = display.mechanism.backlash_m = 0.0;
  }
  set.force = std::make_unique<SimulatedForceDevice>(force);
  if (name == "cld") {
    CldControllerOptions cld;
    cld.tap = options.tap;
    set.display = std::make_unique<CldController>(cld);
  } else if (name == "maestro") {
    MaestroOptions maestro = options.maestro;
    maestro.tap = options.tap;
    set.display = std::make_unique<MaestroDisplay>(maestro);
  } else {
    set.display = std::make_unique<SimulatedContactDisplay>(display);
  }
  return set;
}

bool all_simulated(const DeviceSet& devices) {
  return (!devices.force || devices.force->capabilities().simulated) &&
         (!devices.display || devices.display->capabilities().simulated);
}

}  // namespace tangent
