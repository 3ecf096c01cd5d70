#include "devices/cld/cld_messages.h"

#include <type_traits>

namespace tangent {

namespace {

// One list of fields per message serves both directions: a writer or a reader visits them in wire order.

class Writer {
 public:
  explicit Writer(CldFrame& frame) : frame_(frame) {}
  template <class T>
  void operator()(const T& value) noexcept {
    if constexpr (std::is_enum_v<T>) {
      (*this)(static_cast<std::underlying_type_t<T>>(value));
    } else {
      const auto bits = static_cast<std::make_unsigned_t<T>>(value);
      for (std::size_t i = 0; i < sizeof(T); ++i) {
        frame_.payload[frame_.length++] = static_cast<std::uint8_t>((static_cast<std::uint64_t>(bits) >> (8 * i)) & 0xffu);
      }
    }
  }

 private:
  CldFrame& frame_;
};

class Reader {
 public:
  explicit Reader(const CldFrame& frame) : frame_(frame) {}
  template <class T>
  void operator()(T& value) noexcept {
    if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> raw{};
      (*this)(raw);
      value = static_cast<T>(raw);
    } else {
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < sizeof(T); ++i) {
        bits |= static_cast<std::uint64_t>(frame_.payload[at_++]) << (8 * i);
      }
      value = static_cast<T>(static_cast<std::make_unsigned_t<T>>(bits));
    }
  }

 private:
  const CldFrame& frame_;
  std::size_t at_ = 0;
};

template <class M, class V> void visit_target(M& m, V v) { v(m.target_nm); }
template <class M, class V> void visit_gains(M& m, V v) {
  v(m.p_per_s2); v(m.i_per_s3); v(m.d_milli_per_s); v(m.target_weight_per_65535);
}
template <class M, class V> void visit_limits(M& m, V v) {
  v(m.lowest_nm); v(m.highest_nm); v(m.fastest_um_per_s); v(m.largest_current_ma);
}
template <class M, class V> void visit_info(M& m, V v) {
  v(m.firmware_version); v(m.serial); v(m.travel_nm); v(m.step_pm); v(m.bandwidth_centihz); v(m.telemetry_hz); v(m.watchdog_ms);
}
template <class M, class V> void visit_telemetry(M& m, V v) {
  v(m.time_us); v(m.position_nm); v(m.target_nm); v(m.current_ma); v(m.state); v(m.fault); v(m.heard_sequence); v(m.missed_frames);
}
template <class M, class V> void visit_refused(M& m, V v) { v(m.type); v(m.sequence); v(m.reason); }

constexpr std::uint8_t kTargetBytes = 4, kGainsBytes = 14, kLimitsBytes = 14, kInfoBytes = 20, kTelemetryBytes = 20,
                       kRefusedBytes = 4;

CldFrame blank(CldType type, std::uint16_t sequence) {
  return {.type = static_cast<std::uint8_t>(type), .sequence = sequence};
}

bool is(const CldFrame& frame, CldType type, std::uint8_t length) {
  return frame.version == kCldVersion && frame.type == static_cast<std::uint8_t>(type) && frame.length == length;
}

}  // namespace

// The visitors take V by value: a reader keeps its place in itself, so one is passed for the whole message.
CldFrame to_frame(const CldTarget& m, std::uint16_t sequence) noexcept {
  CldFrame f = blank(CldType::target, sequence);
  visit_target(m, Writer(f));
  return f;
}
CldFrame to_frame(const CldWireGains& m, std::uint16_t sequence) noexcept {
  CldFrame f = blank(CldType::gains, sequence);
  visit_gains(m, Writer(f));
  return f;
}
CldFrame to_frame(const CldWireLimits& m, std::uint16_t sequence) noexcept {
  CldFrame f = blank(CldType::limits, sequence);
  visit_limits(m, Writer(f));
  return f;
}
CldFrame to_frame(const CldInfo& m, std::uint16_t sequence) noexcept {
  CldFrame f = blank(CldType::info, sequence);
  visit_info(m, Writer(f));
  return f;
}
CldFrame to_frame(const CldTelemetry& m, std::uint16_t sequence) noexcept {
  CldFrame f = blank(CldType::telemetry, sequence);
  visit_telemetry(m, Writer(f));
  return f;
}
CldFrame to_frame(const CldRefused& m, std::uint16_t sequence) noexcept {
  CldFrame f = blank(CldType::refused, sequence);
  visit_refused(m, Writer(f));
  return f;
}
CldFrame bare_frame(CldType type, std::uint16_t sequence) noexcept { return blank(type, sequence); }

std::optional<CldTarget> to_target(const CldFrame& frame) noexcept {
  if (!is(frame, CldType::target, kTargetBytes)) return std::nullopt;
  CldTarget m;
  visit_target(m, Reader(frame));
  return m;
}
std::optional<CldWireGains> to_gains(const CldFrame& frame) noexcept {
  if (!is(frame, CldType::gains, kGainsBytes)) return std::nullopt;
  CldWireGains m;
  visit_gains(m, Reader(frame));
  return m;
}
std::optional<CldWireLimits> to_limits(const CldFrame& frame) noexcept {
  if (!is(frame, CldType::limits, kLimitsBytes)) return std::nullopt;
  CldWireLimits m;
  visit_limits(m, Reader(frame));
  if (m.lowest_nm > m.highest_nm) return std::nullopt;
  return m;
}
std::optional<CldInfo> to_info(const CldFrame& frame) noexcept {
  if (!is(frame, CldType::info, kInfoBytes)) return std::nullopt;
  CldInfo m;
  visit_info(m, Reader(frame));
  return m;
}
std::optional<CldTelemetry> to_telemetry(const CldFrame& frame) noexcept {
  if (!is(frame, CldType::telemetry, kTelemetryBytes)) return std::nullopt;
  CldTelemetry m;
  visit_telemetry(m, Reader(frame));
  if (m.state > CldDeviceState::faulted || m.fault > CldDeviceFault::bad_command) return std::nullopt;
  return m;
}
std::optional<CldRefused> to_refused(const CldFrame& frame) noexcept {
  if (!is(frame, CldType::refused, kRefusedBytes)) return std::nullopt;
  CldRefused m;
  visit_refused(m, Reader(frame));
  return m;
}

const char* to_string(CldDeviceState state) {
  switch (state) {
    case CldDeviceState::idle: return "idle";
    case CldDeviceState::homing: return "homing";
    case CldDeviceState::ready: return "ready";
    case CldDeviceState::faulted: return "faulted";
  }
  return "?";
}

const char* to_string(CldDeviceFault fault) {
  switch (fault) {
    case CldDeviceFault::none: return "none";
    case CldDeviceFault::watchdog: return "watchdog";
    case CldDeviceFault::encoder: return "encoder";
    case CldDeviceFault::overcurrent: return "overcurrent";
    case CldDeviceFault::homing_failed: return "homing failed";
    case CldDeviceFault::bad_command: return "bad command";
  }
  return "?";
}

}  // namespace tangent
