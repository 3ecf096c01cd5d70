// Messages of the CLD protocol (devices/cld_protocol.md): frames <-> structs. Pure functions. Integers on the wire;
// units are in the names. A frame of the wrong type or length, or with an invalid value, gives no message.
#pragma once

#include "devices/cld/cld_frame.h"
#include "devices/device_state.h"

#include <cstdint>
#include <optional>

namespace tangent {

enum class CldType : std::uint8_t {
  // Host to device.
  hello = 0x01,
  target = 0x02,
  gains = 0x03,
  limits = 0x04,
  home = 0x05,
  stop = 0x06,
  clear_fault = 0x07,
  // Device to host.
  info = 0x81,
  telemetry = 0x82,
  refused = 0x83,
};

enum class CldDeviceState : std::uint8_t { idle, homing, ready, faulted };
enum class CldDeviceFault : std::uint8_t { none, watchdog, encoder, overcurrent, homing_failed, bad_command };
/// Of a device that says it is faulted.
DeviceFault fault_of(CldDeviceFault fault) noexcept;

struct CldTarget {
  std::int32_t target_nm = 0;
};

struct CldWireGains {  ///< of the PID; see devices/simulated/cld_mechanism.h
  std::uint32_t p_per_s2 = 0;
  std::uint32_t i_per_s3 = 0;
  std::int32_t d_milli_per_s = 0;
  std::uint16_t target_weight_per_65535 = 65535;
};

struct CldWireLimits {
  std::int32_t lowest_nm = 0, highest_nm = 0;
  std::uint32_t fastest_um_per_s = 0;    ///< of the target; 0: as fast as the drive goes
  std::uint16_t largest_current_ma = 0;  ///< 0: the firmware's own limit
};

struct CldInfo {
  std::uint16_t firmware_version = 0;  ///< major * 256 + minor
  std::uint32_t serial = 0;
  std::uint32_t travel_nm = 0;  ///< end to end
  std::uint32_t step_pm = 0;    ///< of the encoder
  std::uint16_t bandwidth_centihz = 0;
  std::uint16_t telemetry_hz = 0;
  std::uint16_t watchdog_ms = 0;
};

struct CldTelemetry {
  std::uint32_t time_us = 0;  ///< device clock, wraps
  std::int32_t position_nm = 0;
  std::int32_t target_nm = 0;  ///< target in effect
  std::int16_t current_ma = 0;
  CldDeviceState state = CldDeviceState::idle;
  CldDeviceFault fault = CldDeviceFault::none;
  std::uint16_t heard_sequence = 0;  ///< of the newest host frame that the device accepted
  std::uint16_t missed_frames = 0;   ///< host frames lost, counted by sequence number; wraps
};

struct CldRefused {
  std::uint8_t type = 0;  ///< of the refused frame
  std::uint16_t sequence = 0;
  std::uint8_t reason = 0;  ///< 1 version, 2 type, 3 length, 4 value, 5 not allowed in this state
};

/// Encodes a message; never fails.
CldFrame to_frame(const CldTarget& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const CldWireGains& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const CldWireLimits& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const CldInfo& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const CldTelemetry& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const CldRefused& message, std::uint16_t sequence) noexcept;
/// hello, home, stop, clear_fault: no payload.
CldFrame bare_frame(CldType type, std::uint16_t sequence) noexcept;

/// Empty when the frame has another type, version or length, or an unknown state or fault.
std::optional<CldTarget> to_target(const CldFrame& frame) noexcept;
std::optional<CldWireGains> to_gains(const CldFrame& frame) noexcept;
std::optional<CldWireLimits> to_limits(const CldFrame& frame) noexcept;
std::optional<CldInfo> to_info(const CldFrame& frame) noexcept;
std::optional<CldTelemetry> to_telemetry(const CldFrame& frame) noexcept;
std::optional<CldRefused> to_refused(const CldFrame& frame) noexcept;

const char* to_string(CldDeviceState state);
const char* to_string(CldDeviceFault fault);

}  // namespace tangent
