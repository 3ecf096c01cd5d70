// The devices of a session, force and display, each chosen by name. Either may be missing.
#pragma once

#include "devices/contact_display.h"
#include "devices/falcon/falcon_options.h"
#include "devices/force_device.h"
#include "devices/haply/haply_options.h"
#include "devices/maestro/maestro_display.h"
#include "devices/plugin/plugin_options.h"
#include "devices/serial/serial_options.h"
#include "devices/vendor_options.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

struct DeviceSet {
  std::unique_ptr<ForceDevice> force;       ///< null: none
  std::unique_ptr<ContactDisplay> display;  ///< null: none
};

/// What the devices are made with. The options of one device are a struct of its own here, filled by its command line
/// options (workbench/cli).
struct DeviceOptions {
  std::uint64_t seed = 1;  ///< of the simulated devices
  MaestroOptions maestro{};
  FalconOptions falcon{};
  SerialForceOptions serial{};
  PluginOptions plugin{};
  VendorOptions vendor{};  ///< of "openhaptics" and "dhd"
  HaplyOptions haply{};
  UsbTap* tap = nullptr;  ///< sees every USB packet; must outlive the devices
};

/// Which force device and which contact display; any two go together.
struct DeviceNames {
  std::string force = "simulated";
  std::string display = "simulated";
  friend bool operator==(const DeviceNames&, const DeviceNames&) = default;
};

/// "simulated": with the data of a real one (PHANToM Premium 1.5). "ideal": the same without encoder steps, tremor and
/// friction. "scheduled": as simulated, but it calls us, from a thread of its own. "tilt": as
/// simulated, but of the finger's rotations it measures the tilt alone, as the paper's gimbal (Doxon et al. 5.3.2).
/// "falcon": a Novint Falcon on USB. "serial": a microcontroller that speaks the force messages of the CLD protocol.
/// "plugin": a shared library of one's own (devices/plugin). "openhaptics": a 3D Systems Touch or PHANToM, "dhd": a
/// Force Dimension device, each through its maker's library. "haply": a Haply Inverse3, through Haply's service.
/// "none": no force device.
const std::vector<std::string>& force_device_names();
/// "simulated": with the data of the paper's CLD. "ideal": the same without steps and backlash. "cld": a CLD controller
/// on USB. "maestro": a servo on a Pololu Maestro. "none": no display.
const std::vector<std::string>& contact_display_names();
/// One word for both (--device): the display's name, with the force device of that name or, where there is none of that
/// name, the simulated one.
Result<DeviceNames> devices_by_one_name(std::string_view name);
/// "simulated" where both have the name, "simulated and cld" otherwise.
std::string to_string(const DeviceNames& names);

/// Whether these names are of simulated devices, or of none.
bool are_simulated(const DeviceNames& names);

/// Makes the devices, not yet opened. Fails on an unknown name; the error lists the choices.
Result<DeviceSet> make_devices(const DeviceNames& names, const DeviceOptions& options = {});

/// Whether every device of the set is simulated. Simulated devices advance with the servo's ticks, real ones with the
/// clock.
bool all_simulated(const DeviceSet& devices);

}  // namespace tangent
