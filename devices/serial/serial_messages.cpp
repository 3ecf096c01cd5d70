#include "devices/serial/serial_messages.h"

#include "devices/cld/cld_fields.h"

namespace tangent {

namespace {

constexpr std::uint8_t byte_of(SerialType type) { return static_cast<std::uint8_t>(type); }

constexpr auto kHelloFields = std::tuple(&ForceHello::lowest_version, &ForceHello::highest_version);
constexpr auto kInfoFields =
    std::tuple(&ForceInfo::version, &ForceInfo::firmware_version, &ForceInfo::serial, &ForceInfo::pushes_along,
               &ForceInfo::senses_rotation, &ForceInfo::buttons, &ForceInfo::peak_mn, &ForceInfo::continuous_mn,
               &ForceInfo::step_nm, &ForceInfo::mass_g, &ForceInfo::stiffness_n_per_m, &ForceInfo::damping_mn_s_per_m,
               &ForceInfo::workspace_um, &ForceInfo::telemetry_hz, &ForceInfo::watchdog_ms, &ForceInfo::homing_ms);
constexpr auto kTelemetryFields =
    std::tuple(&ForceTelemetry::time_us, &ForceTelemetry::position_nm, &ForceTelemetry::force_mn,
               &ForceTelemetry::orientation, &ForceTelemetry::buttons, &ForceTelemetry::state, &ForceTelemetry::fault,
               &ForceTelemetry::heard_sequence, &ForceTelemetry::missed_frames);
constexpr auto kCommandFields = std::tuple(&ForceCommandMessage::force_un, &ForceCommandMessage::request);

}  // namespace

CldFrame to_frame(const ForceHello& m, std::uint16_t sequence) noexcept {
  return cld_written(byte_of(SerialType::force_hello), m, kHelloFields, sequence);
}
CldFrame to_frame(const ForceInfo& m, std::uint16_t sequence) noexcept {
  return cld_written(byte_of(SerialType::force_info), m, kInfoFields, sequence);
}
CldFrame to_frame(const ForceTelemetry& m, std::uint16_t sequence) noexcept {
  return cld_written(byte_of(SerialType::force_telemetry), m, kTelemetryFields, sequence);
}
CldFrame to_frame(const ForceCommandMessage& m, std::uint16_t sequence) noexcept {
  return cld_written(byte_of(SerialType::force_command), m, kCommandFields, sequence);
}

std::optional<ForceHello> to_force_hello(const CldFrame& frame) noexcept {
  const auto m = cld_read<ForceHello>(byte_of(SerialType::force_hello), frame, kHelloFields);
  return m && m->lowest_version <= m->highest_version ? m : std::nullopt;
}
std::optional<ForceInfo> to_force_info(const CldFrame& frame) noexcept {
  return cld_read<ForceInfo>(byte_of(SerialType::force_info), frame, kInfoFields);
}
std::optional<ForceTelemetry> to_force_telemetry(const CldFrame& frame) noexcept {
  const auto m = cld_read<ForceTelemetry>(byte_of(SerialType::force_telemetry), frame, kTelemetryFields);
  return m && m->state <= CldDeviceState::faulted && m->fault <= CldDeviceFault::bad_command ? m : std::nullopt;
}
std::optional<ForceCommandMessage> to_force_command(const CldFrame& frame) noexcept {
  const auto m = cld_read<ForceCommandMessage>(byte_of(SerialType::force_command), frame, kCommandFields);
  return m && m->request <= SerialRequest::clear_fault ? m : std::nullopt;
}

}  // namespace tangent
