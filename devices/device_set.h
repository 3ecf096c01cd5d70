// The devices of a session, chosen by name. Either may be missing.
#pragma once

#include "devices/contact_display.h"
#include "devices/force_device.h"
#include "devices/maestro/maestro_display.h"

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

struct DeviceOptions {
  std::uint64_t seed = 1;  ///< of the simulated devices
  MaestroOptions maestro{};
  UsbTap* tap = nullptr;  ///< sees every USB packet; must outlive the devices
};

/// "simulated": force device and contact display with the data of real ones (PHANToM Premium 1.5, the paper's CLD).
/// "ideal": the same without encoder steps, tremor, friction and backlash.
/// "cld": a CLD controller on USB and the simulated force device. "maestro": a servo on a Pololu Maestro, likewise.
/// "none": neither.
const std::vector<std::string>& device_set_names();

/// Makes the devices of that set, not yet opened. Fails on an unknown name; the error lists the choices.
Result<DeviceSet> make_devices(std::string_view name, const DeviceOptions& options = {});

/// Whether every device of the set is simulated. Simulated devices advance with the servo's ticks, real ones with the
/// clock.
bool all_simulated(const DeviceSet& devices);

}  // namespace tangent
