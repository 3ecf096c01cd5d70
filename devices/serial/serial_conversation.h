// The host's side of the line: what it says, what it makes of the answers, and what it no longer believes. Pure: bytes
// and times come in, bytes and news go out; no port, no clock, no allocation.
#pragma once

#include "devices/serial/sample_check.h"

#include <array>
#include <cstdint>
#include <span>

namespace tangent {

/// For the servo thread.
struct SerialNews {
  std::uint32_t connection = 0;                 ///< odd while connected, incremented on every change
  bool informed = false;                        ///< it said what it is, and may be used
  bool heard = false;                           ///< the rest is of this connection
  SerialTrouble trouble = SerialTrouble::none;  ///< latched until cleared, or it is connected again
  CldDeviceState state = CldDeviceState::idle;
  CldDeviceFault fault = CldDeviceFault::none;
  SerialSample sample;
  std::uint32_t buttons = 0;
  std::int64_t arrived_ns = 0, measured_ns = 0;  ///< on the host's clock
};

struct SerialCounts {
  std::uint64_t frames = 0, crc_errors = 0, skipped_bytes = 0, lost = 0, doubled = 0, late = 0, refused = 0,
                lost_by_device = 0;
};

class SerialConversation {
 public:
  static constexpr std::size_t kLargestTurn = 2 * kCldLargestFrame;  ///< bytes that one compose makes at most

  /// The device that is expected from now on; any other one is refused. Without, the first that answers is taken.
  void expect(const ForceInfo& info) noexcept;

  void connected(std::int64_t now_ns) noexcept;
  void closed() noexcept;  ///< harmless when it is closed already
  void receive(std::span<const std::uint8_t> bytes, std::int64_t now_ns) noexcept;

  /// The next frames; to be called again and again: until the device has said what it is, they ask for that. No force
  /// goes out while there is trouble, and a stop once. `command`: null, when there is none to send.
  std::size_t compose(const ForceCommandMessage* command, std::int64_t now_ns, std::span<std::uint8_t> out) noexcept;
  /// Whether compose has something to say without a command.
  bool has_to_speak(std::int64_t now_ns) const noexcept;
  /// The line takes nothing.
  void note_deaf() noexcept { find(SerialTrouble::deaf); }

  const SerialNews& news() const { return news_; }
  const ForceInfo& info() const { return info_; }
  const SerialCounts& counts() const { return counts_; }

 private:
  void find(SerialTrouble trouble) noexcept;
  void clear() noexcept;
  bool floods(std::size_t bytes, std::int64_t now_ns) noexcept;
  void take_frame(const CldFrame& frame, std::int64_t now_ns) noexcept;
  void take_info(const ForceInfo& info) noexcept;
  void take_refused(const CldRefused& refused) noexcept;
  void take_telemetry(const ForceTelemetry& telemetry, std::int64_t now_ns) noexcept;
  ForceCommandMessage believed(const ForceCommandMessage& command) noexcept;

  SerialNews news_;
  SerialCounts counts_;
  ForceInfo info_;
  bool expecting_ = false, stop_due_ = false;
  CldParser parser_;
  CldSequence sequence_;
  SampleClock clock_;
  std::uint16_t next_sequence_ = 0;
  std::int64_t hello_ns_ = 0, connected_ns_ = 0, allowed_since_ns_ = 0;
  double allowed_bytes_ = 0.0;
};

}  // namespace tangent
