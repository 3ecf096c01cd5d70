// Force messages of the CLD protocol (devices/cld_protocol.md): frames <-> structs. Pure functions. Integers on the
// wire, units in the names; in the device's own frame: x away from the person, y to the left, z up, origin in the
// middle of the workspace. A frame of the wrong type or length, or with an invalid value, gives no message.
#pragma once

#include "devices/cld/cld_messages.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace tangent {

enum class SerialType : std::uint8_t {
  // Host to device.
  force_hello = 0x10,
  force_command = 0x11,
  // Device to host.
  force_info = 0x90,
  force_telemetry = 0x91,
};

/// Of the force messages; that of the frame stays 1.
inline constexpr std::uint8_t kForceVersion = 1;
/// In place of a coordinate: the sensor gave none.
inline constexpr std::int32_t kNotMeasured = std::numeric_limits<std::int32_t>::min();
inline constexpr double kQuaternionUnit = 1.0 / 32767.0;

enum class SerialRequest : std::uint8_t { none, home, stop, clear_fault };

struct ForceHello {  ///< versions that the host speaks
  std::uint8_t lowest_version = kForceVersion, highest_version = kForceVersion;
};

struct ForceInfo {
  std::uint8_t version = kForceVersion;  ///< that it will speak: the highest that both know
  std::uint16_t firmware_version = 0;    ///< major * 256 + minor
  std::uint32_t serial = 0;              ///< 0: none
  std::uint8_t pushes_along = 0;         ///< bit 0: x, 1: y, 2: z
  std::uint8_t senses_rotation = 0;      ///< bit 0: roll, 1: tilt, 2: turn
  std::uint8_t buttons = 0;
  std::uint16_t peak_mn = 0, continuous_mn = 0;
  std::uint32_t step_nm = 0;                    ///< of the position
  std::uint16_t mass_g = 0;                     ///< apparent, at the finger
  std::uint32_t stiffness_n_per_m = 0;          ///< largest that it renders stably; 0: not known, as all of these
  std::uint16_t damping_mn_s_per_m = 0;         ///< largest that it renders stably
  std::array<std::uint32_t, 3> workspace_um{};  ///< half sizes; 0: not known, or no such axis
  std::uint16_t telemetry_hz = 0;
  std::uint16_t watchdog_ms = 0;
  std::uint16_t homing_ms = 0;  ///< takes no longer; 0: homed by hand
  bool operator==(const ForceInfo&) const = default;
};

struct ForceTelemetry {
  std::uint32_t time_us = 0;                  ///< device clock, wraps: when the position was measured
  std::array<std::int32_t, 3> position_nm{};  ///< kNotMeasured: the sensor failed
  std::array<std::int16_t, 3> force_mn{};     ///< in effect
  std::array<std::int16_t, 4> orientation{};  ///< w, x, y, z in kQuaternionUnit; not read where none is sensed
  std::uint32_t buttons = 0;
  CldDeviceState state = CldDeviceState::idle;
  CldDeviceFault fault = CldDeviceFault::none;
  std::uint16_t heard_sequence = 0;  ///< of the newest host frame that the device accepted
  std::uint16_t missed_frames = 0;   ///< host frames lost, counted by sequence number; wraps
};

struct ForceCommandMessage {
  std::array<std::int32_t, 3> force_un{};  ///< micronewtons; carried out in ready only. Resets the watchdog
  SerialRequest request = SerialRequest::none;
};

CldFrame to_frame(const ForceHello& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const ForceInfo& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const ForceTelemetry& message, std::uint16_t sequence) noexcept;
CldFrame to_frame(const ForceCommandMessage& message, std::uint16_t sequence) noexcept;

std::optional<ForceHello> to_force_hello(const CldFrame& frame) noexcept;
std::optional<ForceInfo> to_force_info(const CldFrame& frame) noexcept;
std::optional<ForceTelemetry> to_force_telemetry(const CldFrame& frame) noexcept;
std::optional<ForceCommandMessage> to_force_command(const CldFrame& frame) noexcept;

}  // namespace tangent
