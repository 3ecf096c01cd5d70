// The part of OpenHaptics' HD interface that we use: names, types and numbers, written down anew from what is
// published.
//
// Functions and their order: 3D Systems, OpenHaptics Toolkit 3.5.0, API Reference Guide, "Device routines",
// "Calibration routines", "Scheduler routines", "HDAPI types", and Programmer's Guide, "HDAPI programming". Numbers and
// types: the guide names them without values; the values are those that public programs in other languages use
// (Kirurobo, ManagedPhantom, HdAPI.cs; ctypes and JNI bindings), where each agrees with the others. Units (mm, mm/s,
// N): the guide's table of parameters. None of this was tried on a device.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <string>

namespace tangent::hd {

using Handle = unsigned int;               // HHD
using Enum = unsigned int;                 // HDenum
using ErrorCode = unsigned int;            // HDerror
using CallbackCode = unsigned int;         // HDCallbackCode
using Callback = CallbackCode (*)(void*);  // HDSchedulerCallback
using SchedulerHandle = unsigned long;     // HDSchedulerHandle

/// HDErrorInfo: the newest error that was not yet read, and its device.
struct ErrorInfo {
  ErrorCode code;
  int internal;
  Handle device;
};

inline constexpr Handle kInvalidHandle = 0xFFFFFFFF;  // HD_INVALID_HANDLE
inline constexpr CallbackCode kContinue = 1;          // HD_CALLBACK_CONTINUE; 0 ends the callback
inline constexpr unsigned short kPriority = 32767;    // HD_DEFAULT_SCHEDULER_PRIORITY

// hdGet*: what is asked for.
inline constexpr Enum kButtons = 0x2000;             // HD_CURRENT_BUTTONS, a bit each
inline constexpr Enum kPosition = 0x2050;            // HD_CURRENT_POSITION, 3, mm
inline constexpr Enum kVelocity = 0x2051;            // HD_CURRENT_VELOCITY, 3, mm/s
inline constexpr Enum kTransform = 0x2052;           // HD_CURRENT_TRANSFORM, 16, column after column, mm
inline constexpr Enum kVersion = 0x2500;             // HD_VERSION, a text
inline constexpr Enum kModel = 0x2501;               // HD_DEVICE_MODEL_TYPE, a text
inline constexpr Enum kDriver = 0x2502;              // HD_DEVICE_DRIVER_VERSION, a text
inline constexpr Enum kSerial = 0x2504;              // HD_DEVICE_SERIAL_NUMBER, a text
inline constexpr Enum kMaxWorkspace = 0x2550;        // HD_MAX_WORKSPACE_DIMENSIONS, 6: lowest and highest corner, mm
inline constexpr Enum kUsableWorkspace = 0x2551;     // HD_USABLE_WORKSPACE_DIMENSIONS, the same
inline constexpr Enum kInputDof = 0x2553;            // HD_INPUT_DOF
inline constexpr Enum kCalibrationStyles = 0x2555;   // HD_CALIBRATION_STYLE, a bit each
inline constexpr Enum kMaxStiffness = 0x2602;        // HD_NOMINAL_MAX_STIFFNESS, N/mm
inline constexpr Enum kMaxForce = 0x2603;            // HD_NOMINAL_MAX_FORCE, N
inline constexpr Enum kMaxContinuousForce = 0x2604;  // HD_NOMINAL_MAX_CONTINUOUS_FORCE, N
// hdSet*
inline constexpr Enum kForce = 0x2700;  // HD_CURRENT_FORCE, 3, N
// hdEnable, hdDisable
inline constexpr Enum kForceOutput = 0x4000;  // HD_FORCE_OUTPUT
// hdCheckCalibration
inline constexpr Enum kCalibrationOk = 0x5000;           // HD_CALIBRATION_OK
inline constexpr Enum kCalibrationNeedsUpdate = 0x5001;  // HD_CALIBRATION_NEEDS_UPDATE: now it can be calibrated
inline constexpr Enum kCalibrationNeedsHand = 0x5002;    // HD_CALIBRATION_NEEDS_MANUAL_INPUT
// hdUpdateCalibration takes one of these.
inline constexpr Enum kEncoderReset = 1u << 0;  // HD_CALIBRATION_ENCODER_RESET
inline constexpr Enum kAuto = 1u << 1;          // HD_CALIBRATION_AUTO
inline constexpr Enum kInkwell = 1u << 2;       // HD_CALIBRATION_INKWELL

/// The functions, by the names that follow "hd" in the library.
struct Api {
  Handle (*init_device)(const char* name);  ///< null: the default device
  void (*disable_device)(Handle device);
  void (*begin_frame)(Handle device);  ///< frames: in the scheduler's thread alone
  void (*end_frame)(Handle device);
  void (*enable)(Enum capability);
  void (*disable)(Enum capability);
  void (*get_doublev)(Enum what, double* values);
  void (*get_integerv)(Enum what, int* values);
  const char* (*get_string)(Enum what);
  void (*set_doublev)(Enum what, const double* values);
  ErrorInfo (*get_error)();  ///< takes the newest off the stack of errors
  Enum (*check_calibration)();
  void (*update_calibration)(Enum style);
  SchedulerHandle (*schedule_asynchronous)(Callback callback, void* context, unsigned short priority);
  void (*unschedule)(SchedulerHandle handle);
  void (*set_scheduler_rate)(unsigned long rate_hz);
  void (*start_scheduler)();
  void (*stop_scheduler)();
};

/// Loads the library. Fails when there is none, or it lacks one of the functions, which are then named.
Result<Api> load(const std::filesystem::path& path);

/// Empty when the library's version (HD_VERSION, "3.4.0") is one that these names are of, or says nothing: 3 or newer.
Status check_version(const char* version);

}  // namespace tangent::hd
