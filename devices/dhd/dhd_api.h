// The part of Force Dimension's SDK (DHD) that we use: names, types and numbers, written down anew from what is
// published.
//
// Functions, what they return, units (m, m/s, N) and axes: Force Dimension, Haptic SDK reference
// (downloads.forcedimension.com/sdk/doc/fdsdk-3.14.0/dhd), whose text the Python bindings forcedimension_core repeat
// function by function. Numbers and argument types: those bindings' constants and argtypes. None of this was tried on a
// device.
#pragma once

#include "core/base/result.h"

#include <filesystem>

namespace tangent::dhd {

// Return values: below 0 an error, dhdErrorGetLast says which.
inline constexpr int kTimeGuard = 1;       // DHD_TIMEGUARD: nothing was asked of the device, the last answer is recent
inline constexpr int kMotorSaturated = 2;  // DHD_MOTOR_SATURATED: the force was scaled down, its direction kept

// Of dhdGetStatus, each 0 or 1 but for the last.
inline constexpr int kStatusPower = 0;           // DHD_STATUS_POWER
inline constexpr int kStatusConnected = 1;       // DHD_STATUS_CONNECTED
inline constexpr int kStatusReset = 3;           // DHD_STATUS_RESET: it is calibrated
inline constexpr int kStatusForce = 5;           // DHD_STATUS_FORCE: its motors are on
inline constexpr int kStatusError = 9;           // DHD_STATUS_ERROR
inline constexpr int kStatusForceOffCause = 14;  // DHD_STATUS_FORCEOFFCAUSE: 0 to 6
inline constexpr int kStatusRoom = 64;           // DHD_MAX_STATUS is 16; later SDKs may say more

inline constexpr unsigned char kOn = 1;  // DHD_ON
inline constexpr int kMostButtons = 16;  // DHD_MAX_BUTTONS

/// The functions, by the names that follow "dhd" in the library. `id`: as dhdOpenID returned it.
struct Api {
  void (*get_sdk_version)(int* major, int* minor, int* release, int* revision);
  int (*get_device_count)();
  int (*open_id)(char index);
  int (*open_serial)(int serial);
  int (*close)(char id);
  int (*stop)(char id);  ///< no force, brakes on
  int (*error_get_last)();
  int (*get_serial_number)(unsigned short* serial, char id);
  int (*get_system_type)(char id);
  const char* (*get_system_name)(char id);
  bool (*has_wrist)(char id);
  int (*get_status)(int* status, char id);
  int (*enable_force)(unsigned char on, char id);
  int (*get_position)(double* x, double* y, double* z, char id);
  int (*get_linear_velocity)(double* x, double* y, double* z, char id);
  int (*get_orientation_frame)(double matrix[3][3], char id);
  unsigned (*get_button_mask)(char id);
  /// Force, torque, gripper's force.
  int (*set_force)(double fx, double fy, double fz, double tx, double ty, double tz, double fg, char id);
  /// Time without a command after which the firmware stops, in 125 us; null: the library can't say.
  int (*get_watchdog)(unsigned char* value, char id);
};

/// Loads the library. Fails when there is none, it lacks one of the functions (named), or is older than 3.3.
Result<Api> load(const std::filesystem::path& path);

}  // namespace tangent::dhd
