// Frames of the CLD protocol (devices/cld_protocol.md): bytes <-> frames. Pure: no device, no clock, no allocation.
//
//   0      1        2     3       4..5      6 .. 6+n-1  6+n .. 7+n
//   0xC5   version  type  length  sequence  payload     CRC-16 over bytes 1 .. 5+n
// Little-endian. Frames may be split over USB packets and several may share one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace tangent {

inline constexpr std::uint8_t kCldSync = 0xC5;
inline constexpr std::uint8_t kCldVersion = 1;
inline constexpr std::size_t kCldHeaderBytes = 6, kCldCrcBytes = 2;
inline constexpr std::size_t kCldLargestPayload = 48;
inline constexpr std::size_t kCldLargestFrame = kCldHeaderBytes + kCldLargestPayload + kCldCrcBytes;

struct CldFrame {
  std::uint8_t version = kCldVersion;
  std::uint8_t type = 0;
  std::uint16_t sequence = 0;
  std::uint8_t length = 0;                                 ///< of the payload
  std::array<std::uint8_t, kCldLargestPayload> payload{};  ///< zero beyond length

  std::span<const std::uint8_t> bytes() const { return {payload.data(), length}; }
  bool operator==(const CldFrame&) const = default;
};

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF, not reflected. Of "123456789": 0x29B1.
std::uint16_t cld_crc(std::span<const std::uint8_t> bytes) noexcept;

/// Writes the frame to `out`; returns the number of bytes written. Preconditions: length <= kCldLargestPayload,
/// out.size() >= kCldLargestFrame.
std::size_t encode_frame(const CldFrame& frame, std::span<std::uint8_t> out) noexcept;

/// Counts since the parser was made; they never go back.
struct CldParserCounts {
  std::uint64_t frames = 0;
  std::uint64_t crc_errors = 0;
  std::uint64_t wrong_lengths = 0;  ///< length byte above kCldLargestPayload
  std::uint64_t skipped_bytes = 0;  ///< between frames
};

/// Finds frames in a byte stream that may be split, merged or damaged. After damage it resynchronises at the next sync
/// byte inside the rejected bytes, so that one bad byte does not lose the good frame behind it.
class CldParser {
 public:
  /// Feeds one byte. Returns the frame that it completes, if its CRC is right.
  std::optional<CldFrame> feed(std::uint8_t byte) noexcept;
  /// Feeds all bytes; calls `take(frame)` for every frame found.
  template <class Take>
  void feed(std::span<const std::uint8_t> bytes, Take&& take) {
    for (const std::uint8_t byte : bytes) {
      for (auto frame = feed(byte); frame; frame = next()) take(*frame);
    }
  }
  /// The next frame among bytes already fed, if there is one (after a resynchronisation).
  std::optional<CldFrame> next() noexcept;
  /// Whether the parser holds the beginning of a frame.
  bool in_frame() const noexcept { return held_ > 0; }
  /// Discards a partial frame (the cable was pulled). Counts stay.
  void restart() noexcept { held_ = 0; }
  const CldParserCounts& counts() const { return counts_; }

 private:
  void drop(std::size_t bytes) noexcept;

  std::array<std::uint8_t, kCldLargestFrame> buffer_{};
  std::size_t held_ = 0;
  CldParserCounts counts_;
};

/// Counts lost, duplicated and out-of-order frames by their sequence numbers, which wrap at 2^16.
class CldSequence {
 public:
  enum class Arrival : std::uint8_t { in_order, after_loss, doubled, late };
  /// Classifies and counts a frame that arrived with this sequence number.
  Arrival add(std::uint16_t sequence) noexcept;
  /// The next frame is taken as the first of a new connection. Counts stay.
  void restart() noexcept { known_ = false; }
  std::uint64_t lost() const { return lost_; }  ///< without those that arrived late
  std::uint64_t doubled() const { return doubled_; }
  std::uint64_t late() const { return late_; }

 private:
  bool known_ = false;
  std::uint16_t newest_ = 0;
  std::uint64_t seen_ = 0;  ///< bit i: frame newest - i has arrived
  std::uint64_t lost_ = 0, doubled_ = 0, late_ = 0;
};

}  // namespace tangent
