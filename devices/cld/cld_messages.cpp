#include "devices/cld/cld_messages.h"

#include "devices/cld/cld_fields.h"

namespace tangent {

namespace {

// Type and fields of each message in wire order. Encoding, decoding and length are all derived from this list.
template <class M>
constexpr CldType kType{};
template <class M>
constexpr std::tuple<> kFields{};

template <>
constexpr auto kType<CldTarget> = CldType::target;
template <>
constexpr auto kFields<CldTarget> = std::tuple(&CldTarget::target_nm);
template <>
constexpr auto kType<CldWireGains> = CldType::gains;
template <>
constexpr auto kFields<CldWireGains> = std::tuple(&CldWireGains::p_per_s2, &CldWireGains::i_per_s3,
                                                  &CldWireGains::d_milli_per_s, &CldWireGains::target_weight_per_65535);
template <>
constexpr auto kType<CldWireLimits> = CldType::limits;
template <>
constexpr auto kFields<CldWireLimits> = std::tuple(&CldWireLimits::lowest_nm, &CldWireLimits::highest_nm,
                                                   &CldWireLimits::fastest_um_per_s,
                                                   &CldWireLimits::largest_current_ma);
template <>
constexpr auto kType<CldInfo> = CldType::info;
template <>
constexpr auto kFields<CldInfo> = std::tuple(&CldInfo::firmware_version, &CldInfo::serial, &CldInfo::travel_nm,
                                             &CldInfo::step_pm, &CldInfo::bandwidth_centihz, &CldInfo::telemetry_hz,
                                             &CldInfo::watchdog_ms);
template <>
constexpr auto kType<CldTelemetry> = CldType::telemetry;
template <>
constexpr auto kFields<CldTelemetry> = std::tuple(&CldTelemetry::time_us, &CldTelemetry::position_nm,
                                                  &CldTelemetry::target_nm, &CldTelemetry::current_ma,
                                                  &CldTelemetry::state, &CldTelemetry::fault,
                                                  &CldTelemetry::heard_sequence, &CldTelemetry::missed_frames);
template <>
constexpr auto kType<CldRefused> = CldType::refused;
template <>
constexpr auto kFields<CldRefused> = std::tuple(&CldRefused::type, &CldRefused::sequence, &CldRefused::reason);

template <class M>
CldFrame written(const M& message, std::uint16_t sequence) noexcept {
  return cld_written(static_cast<std::uint8_t>(kType<M>), message, kFields<M>, sequence);
}

/// Empty when the frame has another version, type or length.
template <class M>
std::optional<M> read(const CldFrame& frame) noexcept {
  return cld_read<M>(static_cast<std::uint8_t>(kType<M>), frame, kFields<M>);
}

}  // namespace

CldFrame bare_frame(CldType type, std::uint16_t sequence) noexcept {
  return {.type = static_cast<std::uint8_t>(type), .sequence = sequence};
}

CldFrame to_frame(const CldTarget& m, std::uint16_t sequence) noexcept { return written(m, sequence); }
CldFrame to_frame(const CldWireGains& m, std::uint16_t sequence) noexcept { return written(m, sequence); }
CldFrame to_frame(const CldWireLimits& m, std::uint16_t sequence) noexcept { return written(m, sequence); }
CldFrame to_frame(const CldInfo& m, std::uint16_t sequence) noexcept { return written(m, sequence); }
CldFrame to_frame(const CldTelemetry& m, std::uint16_t sequence) noexcept { return written(m, sequence); }
CldFrame to_frame(const CldRefused& m, std::uint16_t sequence) noexcept { return written(m, sequence); }

std::optional<CldTarget> to_target(const CldFrame& frame) noexcept { return read<CldTarget>(frame); }
std::optional<CldWireGains> to_gains(const CldFrame& frame) noexcept { return read<CldWireGains>(frame); }
std::optional<CldInfo> to_info(const CldFrame& frame) noexcept { return read<CldInfo>(frame); }
std::optional<CldRefused> to_refused(const CldFrame& frame) noexcept { return read<CldRefused>(frame); }
std::optional<CldWireLimits> to_limits(const CldFrame& frame) noexcept {
  const auto m = read<CldWireLimits>(frame);
  return m && m->lowest_nm <= m->highest_nm ? m : std::nullopt;
}
std::optional<CldTelemetry> to_telemetry(const CldFrame& frame) noexcept {
  const auto m = read<CldTelemetry>(frame);
  return m && m->state <= CldDeviceState::faulted && m->fault <= CldDeviceFault::bad_command ? m : std::nullopt;
}

const char* to_string(CldDeviceState state) {
  switch (state) {
    case CldDeviceState::idle:
      return "idle";
    case CldDeviceState::homing:
      return "homing";
    case CldDeviceState::ready:
      return "ready";
    case CldDeviceState::faulted:
      return "faulted";
  }
  return "?";
}

const char* to_string(CldDeviceFault fault) {
  switch (fault) {
    case CldDeviceFault::none:
      return "none";
    case CldDeviceFault::watchdog:
      return "watchdog";
    case CldDeviceFault::encoder:
      return "encoder";
    case CldDeviceFault::overcurrent:
      return "overcurrent";
    case CldDeviceFault::homing_failed:
      return "homing failed";
    case CldDeviceFault::bad_command:
      return "bad command";
  }
  return "?";
}

DeviceFault fault_of(CldDeviceFault fault) noexcept {
  switch (fault) {
    case CldDeviceFault::watchdog:
      return DeviceFault::watchdog;
    case CldDeviceFault::encoder:
      return DeviceFault::sensor;
    case CldDeviceFault::bad_command:
      return DeviceFault::bad_command;
    case CldDeviceFault::none:
    case CldDeviceFault::overcurrent:
    case CldDeviceFault::homing_failed:
      break;
  }
  return DeviceFault::actuator;
}

}  // namespace tangent
