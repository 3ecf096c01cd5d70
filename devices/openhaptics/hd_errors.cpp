#include "devices/openhaptics/hd_errors.h"

#include <array>
#include <cstdio>
#include <utility>

namespace tangent::hd {

namespace {

constexpr const char* kReport = "report it, with the version of OpenHaptics";
constexpr const char* kCool = "let go of the handle and let the motors cool for some minutes, then arm again";
constexpr const char* kSlower = "arm again; use a softer preset, or less damping, if it comes again";
constexpr const char* kCable =
    "plug in cable and power; see with `ls -l /dev/ttyACM* /dev/hidraw*` that you may write to it "
    "(devices/60-tangent-workbench.rules, or group dialout); it is looked for again by itself";
constexpr const char* kSetup = "run the maker's setup program (Touch_Setup) and its diagnostics, then arm again";

constexpr Explained kNone{0x0000, DeviceFault::none, "HD_SUCCESS", "no error", ""};
constexpr Explained kUnknown{0xFFFF, DeviceFault::firmware, "unknown", "an error that is not in OpenHaptics' guide",
                             kReport};

constexpr std::array kCodes{
    Explained{0x0100, DeviceFault::firmware, "HD_INVALID_ENUM", "the library does not know what it was asked for",
              "install OpenHaptics 3.4 or newer"},
    Explained{0x0101, DeviceFault::firmware, "HD_INVALID_VALUE", "the library refuses a value", kReport},
    Explained{0x0102, DeviceFault::firmware, "HD_INVALID_OPERATION", "the library refuses the call now", kReport},
    Explained{0x0103, DeviceFault::firmware, "HD_INVALID_INPUT_TYPE", "the library refuses the type of a value",
              kReport},
    Explained{0x0104, DeviceFault::firmware, "HD_BAD_HANDLE", "the library does not know the device any more",
              "choose the device again"},
    Explained{0x0200, DeviceFault::actuator, "HD_WARM_MOTORS", "the motors are too warm", kCool},
    Explained{0x0201, DeviceFault::actuator, "HD_EXCEEDED_MAX_FORCE", "the force was more than the device allows",
              kSlower},
    Explained{0x0202, DeviceFault::actuator, "HD_EXCEEDED_MAX_FORCE_IMPULSE",
              "the force changed too fast for the device", kSlower},
    Explained{0x0203, DeviceFault::actuator, "HD_EXCEEDED_MAX_VELOCITY", "the handle moved too fast for the device",
              "hold the handle, then arm again"},
    Explained{0x0204, DeviceFault::actuator, "HD_FORCE_ERROR", "the device could not render the force", kSetup},
    Explained{0x0300, DeviceFault::actuator, "HD_DEVICE_FAULT", "the device reports a fault of its own", kSetup},
    Explained{0x0301, DeviceFault::firmware, "HD_DEVICE_ALREADY_INITIATED", "the device is in use",
              "close the other program that uses it"},
    Explained{0x0302, DeviceFault::disconnected, "HD_COMM_ERROR", "the device does not answer", kCable},
    Explained{0x0303, DeviceFault::disconnected, "HD_COMM_CONFIG_ERROR", "the device answers another driver or set-up",
              kSetup},
    Explained{0x0304, DeviceFault::watchdog, "HD_TIMER_ERROR", "the library's scheduler can't keep time",
              "close other programs; allow real-time priority (devices/README.md)"},
    Explained{0x0400, DeviceFault::firmware, "HD_ILLEGAL_BEGIN", "a frame was begun twice", kReport},
    Explained{0x0401, DeviceFault::firmware, "HD_ILLEGAL_END", "a frame was ended that was not begun", kReport},
    Explained{0x0402, DeviceFault::firmware, "HD_FRAME_ERROR", "a value was set outside a frame", kReport},
    Explained{0x0500, DeviceFault::firmware, "HD_INVALID_PRIORITY", "the scheduler refuses the priority", kReport},
    Explained{0x0501, DeviceFault::firmware, "HD_SCHEDULER_FULL", "the scheduler takes no more callbacks",
              "close other programs that use the device"},
    Explained{0x0600, DeviceFault::firmware, "HD_INVALID_LICENSE", "OpenHaptics finds no licence",
              "install its licence, or the Developer Edition (support.3dsystems.com)"},
};

}  // namespace

const Explained& explain(ErrorCode code) noexcept {
  if (code == kSuccess) return kNone;
  for (const Explained& known : kCodes)
    if (known.code == code) return known;
  return kUnknown;
}

bool is_frame_error(ErrorCode code) noexcept { return code >= 0x0400 && code <= 0x0402; }

Error to_error(ErrorCode code, std::string where) {
  const Explained& known = explain(code);
  char number[16];
  std::snprintf(number, sizeof number, "0x%04X", code);
  return {std::string(known.what) + " (" + known.name + ", " + number + ")", std::move(where), known.remedy};
}

}  // namespace tangent::hd
