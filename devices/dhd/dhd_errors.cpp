#include "devices/dhd/dhd_errors.h"

#include <array>
#include <utility>

namespace tangent::dhd {

namespace {

using enum DeviceFault;

constexpr const char* kTell = "report it, with the version of the SDK";
constexpr const char* kPlug =
    "plug in cable and power; see with `lsusb -d 1451:` that it is there, and that you may open it "
    "(devices/60-tangent-workbench.rules); it is looked for again by itself";
constexpr const char* kNewer = "install a newer SDK (forcedimension.com/software/sdk)";
constexpr const char* kBring = "bring the handle back into its workspace, then arm again";

constexpr Explained kNotKnown{firmware, "unknown", "an error that is not in the SDK's reference", kTell};

constexpr std::array<Explained, kErrors> kErrorTable{{
    {none, "DHD_NO_ERROR", "no error", ""},
    {firmware, "DHD_ERROR", "an error without a name", kTell},
    {disconnected, "DHD_ERROR_COM", "the device does not answer", kPlug},
    {disconnected, "DHD_ERROR_DHC_BUSY", "its controller is busy", "switch it off and on again"},
    {disconnected, "DHD_ERROR_NO_DRIVER_FOUND", "the system has no driver for it", "install the SDK with its driver"},
    {disconnected, "DHD_ERROR_NO_DEVICE_FOUND", "no such device is found", kPlug},
    {firmware, "DHD_ERROR_NOT_AVAILABLE", "this device can't do what was asked", kTell},
    {disconnected, "DHD_ERROR_TIMEOUT", "the device did not answer in time", kPlug},
    {sensor, "DHD_ERROR_GEOMETRY", "its joints read what no place of the handle can give", kBring},
    {firmware, "DHD_ERROR_EXPERT_MODE_DISABLED", "the call needs the SDK's expert mode", kTell},
    {firmware, "DHD_ERROR_NOT_IMPLEMENTED", "the SDK has not implemented the call", kNewer},
    {firmware, "DHD_ERROR_OUT_OF_MEMORY", "the SDK is out of memory", "close other programs"},
    {sensor, "DHD_ERROR_DEVICE_NOT_READY", "the device is not ready",
     "calibrate it: bring the handle to its rest position until its light stops blinking"},
    {firmware, "DHD_ERROR_FILE_NOT_FOUND", "the SDK misses one of its files", "install the SDK again"},
    {firmware, "DHD_ERROR_CONFIGURATION", "the device's configuration can't be read",
     "see to it with the maker's HapticDesk"},
    {firmware, "DHD_ERROR_INVALID_INDEX", "the SDK does not know the device any more", "choose the device again"},
    {firmware, "DHD_ERROR_DEPRECATED", "the SDK has given up the call", "report it; an older SDK may do"},
    {firmware, "DHD_ERROR_NULL_ARGUMENT", "the SDK refuses a value", kTell},
    {sensor, "DHD_ERROR_REDUNDANT_FAIL", "its two sets of sensors disagree",
     "don't use it: have it looked at by the maker"},
    {actuator, "DHD_ERROR_NOT_ENABLED", "what was asked for is switched off", "press the device's force button"},
    {disconnected, "DHD_ERROR_DEVICE_IN_USE", "another program uses it", "close the other program"},
    {bad_command, "DHD_ERROR_INVALID", "the SDK refuses a value", kTell},
    {firmware, "DHD_ERROR_NO_REGULATION", "the SDK's robotic part does not run", kTell},
}};

constexpr const char* kButton = "press the device's force button, then arm again";
constexpr std::array<Explained, kForceOffCauses> kCauseTable{{
    {actuator, "DHD_FORCEOFF_NONE", "its force is off, without a cause", kButton},
    {actuator, "DHD_FORCEOFF_BUTTON", "its force button was pressed", kButton},
    {actuator, "DHD_FORCEOFF_VELOCITY", "the handle moved too fast, and it has put the brakes on",
     "hold the handle, press its force button, then arm again"},
    {watchdog, "DHD_FORCEOFF_WATCHDOG", "its firmware received no command in time",
     "allow real-time priority (devices/README.md), then arm again"},
    {actuator, "DHD_FORCEOFF_SOFTWARE", "a program switched its force off", "arm again"},
    {disconnected, "DHD_FORCEOFF_USBDISCN", "its cable was unplugged", kPlug},
    {actuator, "DHD_FORCEOFF_DEADMAN", "nobody holds its dead man's switch", "hold the handle, then arm again"},
}};

template <std::size_t Size>
const Explained& entry(const std::array<Explained, Size>& table, int code) noexcept {
  return code >= 0 && static_cast<std::size_t>(code) < Size ? table[static_cast<std::size_t>(code)] : kNotKnown;
}

Error worded(const Explained& known, int code, std::string where) {
  return {std::string(known.what) + " (" + known.name + ", " + std::to_string(code) + ")", std::move(where),
          known.remedy};
}

}  // namespace

const Explained& explain(int code) noexcept { return entry(kErrorTable, code); }
const Explained& explain_force_off(int cause) noexcept { return entry(kCauseTable, cause); }

Error to_error(int code, std::string where) { return worded(explain(code), code, std::move(where)); }
Error force_off_error(int cause, std::string where) {
  return worded(explain_force_off(cause), cause, std::move(where));
}

}  // namespace tangent::dhd
