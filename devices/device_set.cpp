#include "devices/device_set.h"

#include "devices/cld/cld_controller.h"
#include "devices/dhd/dhd_force_device.h"
#include "devices/falcon/falcon_device.h"
#include "devices/found_device.h"
#include "devices/haply/haply_device.h"
#include "devices/haply/haply_list.h"
#include "devices/openhaptics/hd_force_device.h"
#include "devices/openhaptics/hd_setups.h"
#include "devices/plugin/plugin_device.h"
#include "devices/serial/serial_force_device.h"
#include "devices/simulated/scheduled_force_device.h"
#include "devices/simulated/simulated_contact_display.h"
#include "devices/simulated/simulated_force_device.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tangent {

namespace {

template <class Device>
struct DeviceKind {
  const char* name;
  bool simulated;  // or none
  std::unique_ptr<Device> (*make)(const DeviceOptions& options);
  std::vector<FoundDevice> (*find)(const DeviceOptions& options) = nullptr;  // those attached; null: none to look for
};

std::unique_ptr<ForceDevice> simulated_force(const DeviceOptions& options) {
  return std::make_unique<SimulatedForceDevice>(SimulatedForceOptions{.seed = options.seed});
}

std::unique_ptr<ForceDevice> ideal_force(const DeviceOptions& options) {
  SimulatedForceOptions ideal{.seed = options.seed};
  ideal.position_step_m = ideal.tremor_m = ideal.friction_n = 0.0;
  return std::make_unique<SimulatedForceDevice>(ideal);
}

std::unique_ptr<ForceDevice> tilting_force(const DeviceOptions& options) {
  SimulatedForceOptions tilting{.seed = options.seed};
  tilting.senses_rotation = {false, true, false};
  return std::make_unique<SimulatedForceDevice>(tilting);
}

std::unique_ptr<ForceDevice> scheduled_force(const DeviceOptions& options) {
  return std::make_unique<ScheduledForceDevice>(SimulatedForceOptions{.seed = options.seed});
}

std::unique_ptr<ForceDevice> falcon_force(const DeviceOptions& options) {
  FalconOptions wanted = options.falcon;
  wanted.tap = options.tap;
  return std::make_unique<FalconDevice>(wanted);
}

std::vector<FoundDevice> find_falcons(const DeviceOptions& options) {
  const auto found = list_usb_devices(options.falcon.link.match, options.falcon.link.interface_number);
  if (!found) return {{"falcon", "", "", found.error()}};
  std::vector<FoundDevice> all;
  for (const UsbDeviceInfo& d : *found) {
    const std::string where = "bus " + std::to_string(d.bus) + ", address " + std::to_string(d.address);
    const Error problem = d.problem == UsbProblem::none ? Error{} : usb_error(d.problem, where, d.problem_detail);
    all.push_back({"falcon", "Novint Falcon on " + where, d.serial, problem});
  }
  return all;
}

std::unique_ptr<ForceDevice> serial_force(const DeviceOptions& options) {
  return std::make_unique<SerialForceDevice>(options.serial);
}

std::vector<FoundDevice> find_serial(const DeviceOptions& options) { return find_serial_devices(options.serial.dev); }

std::unique_ptr<ForceDevice> plugin_force(const DeviceOptions& options) {
  return std::make_unique<PluginForceDevice>(options.plugin);
}

std::unique_ptr<ForceDevice> openhaptics_force(const DeviceOptions& options) {
  return std::make_unique<HdForceDevice>(options.vendor.hd);
}

std::vector<FoundDevice> find_openhaptics(const DeviceOptions& options) {
  const auto set_up = hd::find_set_up(options.vendor.hd);
  if (!set_up) return {{"openhaptics", "", "", set_up.error()}};
  std::vector<FoundDevice> all;
  for (const std::string& name : *set_up)
    all.push_back({.kind = "openhaptics", .name = name, .serial = {}, .attached = false});
  return all;
}

std::unique_ptr<ForceDevice> dhd_force(const DeviceOptions& options) {
  return std::make_unique<DhdForceDevice>(options.vendor.dhd);
}

std::vector<FoundDevice> find_dhd(const DeviceOptions& options) {
  const auto found = find_dhd_devices(options.vendor.dhd);
  if (!found) return {{"dhd", "", "", found.error()}};
  std::vector<FoundDevice> all;
  for (const FoundDhd& d : *found)
    all.push_back({"dhd", d.name, d.serial < 0 ? std::string() : std::to_string(d.serial), d.problem});
  return all;
}

std::unique_ptr<ForceDevice> haply_force(const DeviceOptions& options) {
  return std::make_unique<HaplyForceDevice>(options.haply);
}

std::vector<FoundDevice> find_haply(const DeviceOptions& options) {
  auto found = list_haply_devices(options.haply);
  if (!found) return {{"haply", "", "", found.error()}};
  return *std::move(found);
}

std::unique_ptr<ContactDisplay> simulated_display(const DeviceOptions& options) {
  SimulatedDisplayOptions wanted;
  wanted.seed = options.seed;
  return std::make_unique<SimulatedContactDisplay>(wanted);
}

std::unique_ptr<ContactDisplay> ideal_display(const DeviceOptions& options) {
  SimulatedDisplayOptions ideal;
  ideal.seed = options.seed;
  ideal.mechanism.step_m = ideal.mechanism.backlash_m = 0.0;
  return std::make_unique<SimulatedContactDisplay>(ideal);
}

std::unique_ptr<ContactDisplay> cld(const DeviceOptions& options) {
  CldControllerOptions wanted;
  wanted.tap = options.tap;
  return std::make_unique<CldController>(wanted);
}

std::unique_ptr<ContactDisplay> maestro(const DeviceOptions& options) {
  MaestroOptions wanted = options.maestro;
  wanted.tap = options.tap;
  return std::make_unique<MaestroDisplay>(wanted);
}

// A new device is one row here: {name, simulated, make, find}.
constexpr DeviceKind<ForceDevice> kForceDevices[] = {
    {"simulated", true, simulated_force},
    {"ideal", true, ideal_force},
    {"scheduled", true, scheduled_force},
    {"tilt", true, tilting_force},
    {"falcon", false, falcon_force, find_falcons},
    {"serial", false, serial_force, find_serial},
    {"plugin", false, plugin_force},
    {"openhaptics", false, openhaptics_force, find_openhaptics},
    {"dhd", false, dhd_force, find_dhd},
    {"haply", false, haply_force, find_haply},
    {"none", true, [](const DeviceOptions&) { return std::unique_ptr<ForceDevice>(); }},
};
constexpr DeviceKind<ContactDisplay> kContactDisplays[] = {
    {"simulated", true, simulated_display},
    {"ideal", true, ideal_display},
    {"cld", false, cld},
    {"maestro", false, maestro},
    {"none", true, [](const DeviceOptions&) { return std::unique_ptr<ContactDisplay>(); }},
};

template <class Kinds>
std::vector<std::string> names_of(const Kinds& kinds) {
  std::vector<std::string> names;
  for (const auto& kind : kinds) names.push_back(kind.name);
  return names;
}

template <class Kinds>
auto find_kind(const Kinds& kinds, std::string_view name) {
  return std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& kind) { return kind.name == name; });
}

tl::unexpected<Error> unknown(const char* what, std::string_view name, const char* option,
                              const std::vector<std::string>& names) {
  std::string choices = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) choices += (i + 1 < names.size() ? ", " : " or ") + names[i];
  return fail("unknown " + std::string(what) + " \"" + std::string(name) + "\"", option, "choose " + choices);
}

}  // namespace

const std::vector<std::string>& force_device_names() {
  static const std::vector<std::string> names = names_of(kForceDevices);
  return names;
}

const std::vector<std::string>& contact_display_names() {
  static const std::vector<std::string> names = names_of(kContactDisplays);
  return names;
}

Result<DeviceNames> devices_by_one_name(std::string_view name) {
  if (find_kind(kContactDisplays, name) == std::end(kContactDisplays))
    return unknown("device", name, "--device", contact_display_names());
  DeviceNames names;
  names.display = name;
  if (find_kind(kForceDevices, name) != std::end(kForceDevices)) names.force = name;
  return names;
}

std::string to_string(const DeviceNames& names) {
  return names.force == names.display ? names.force : names.force + " and " + names.display;
}

Result<DeviceSet> make_devices(const DeviceNames& names, const DeviceOptions& options) {
  const auto* force = find_kind(kForceDevices, names.force);
  if (force == std::end(kForceDevices)) return unknown("force device", names.force, "--force", force_device_names());
  const auto* display = find_kind(kContactDisplays, names.display);
  if (display == std::end(kContactDisplays))
    return unknown("contact display", names.display, "--display", contact_display_names());
  return DeviceSet{force->make(options), display->make(options)};
}

std::vector<FoundDevice> find_force_devices(const DeviceOptions& options) {
  std::vector<FoundDevice> all;
  for (const DeviceKind<ForceDevice>& kind : kForceDevices) {
    if (kind.find == nullptr) continue;
    for (FoundDevice& found : kind.find(options)) all.push_back(std::move(found));
  }
  return all;
}

bool is_attached(const std::string& kind, const DeviceOptions& options) {
  const auto* row = find_kind(kForceDevices, kind);
  if (row == std::end(kForceDevices) || row->find == nullptr) return false;
  const std::vector<FoundDevice> found = row->find(options);
  return std::any_of(found.begin(), found.end(), [](const FoundDevice& d) { return d.attached && !d.name.empty(); });
}

std::vector<std::string> sought_force_devices() {
  std::vector<std::string> names;
  for (const DeviceKind<ForceDevice>& kind : kForceDevices)
    if (kind.find != nullptr) names.push_back(kind.name);
  return names;
}

bool are_simulated(const DeviceNames& names) {
  const auto* force = find_kind(kForceDevices, names.force);
  const auto* display = find_kind(kContactDisplays, names.display);
  return (force == std::end(kForceDevices) || force->simulated) &&
         (display == std::end(kContactDisplays) || display->simulated);
}

bool all_simulated(const DeviceSet& devices) {
  return (!devices.force || devices.force->capabilities().simulated) &&
         (!devices.display || devices.display->capabilities().simulated);
}

}  // namespace tangent
