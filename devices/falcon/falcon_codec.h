// The packets of the Novint Falcon's own firmware, and the status bytes that its FTDI chip puts in front.
//
// 16 bytes to the device, each answered by 16: '<', three numbers of 16 bits as four nibbles each, the lowest first,
// byte 13, byte 14, '>'. A nibble is sent as 'A' + nibble. There is no checksum: what can be checked is that every byte
// is one that can occur.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace tangent {

inline constexpr std::size_t kFalconPacketBytes = 16;
using FalconPacket = std::array<std::uint8_t, kFalconPacketBytes>;

/// Lamps in the ring. Public sources disagree on which colour is which; nothing depends on it.
enum FalconLamp : std::uint8_t { kFalconGreen = 2, kFalconBlue = 4, kFalconRed = 8 };

struct FalconCommand {
  std::array<std::int16_t, 3> torque{};  ///< counts, as the firmware takes them
  bool homing = false;                   ///< has to be in every packet for the device to find and keep its zero
  std::uint8_t lamps = 0;                ///< FalconLamp
};

struct FalconAnswer {
  std::array<std::int16_t, 3> encoder{};  ///< ticks
  std::uint8_t buttons = 0;               ///< bits 0 to 3
  std::uint8_t homed = 0;                 ///< a bit for each leg
  bool all_homed() const { return homed == 7; }
};

FalconPacket to_packet(const FalconCommand& command) noexcept;
FalconPacket to_packet(const FalconAnswer& answer) noexcept;
/// Empty when a byte can't occur there.
std::optional<FalconAnswer> to_answer(std::span<const std::uint8_t, kFalconPacketBytes> bytes) noexcept;
std::optional<FalconCommand> to_command(std::span<const std::uint8_t, kFalconPacketBytes> bytes) noexcept;

/// What follows the two status bytes that begin every IN packet of an FTDI chip.
std::span<const std::uint8_t> ftdi_payload(std::span<const std::uint8_t> packet) noexcept;

/// Finds packets in a stream of bytes that may be cut anywhere. Allocates nothing.
class FalconParser {
 public:
  /// Calls `each(packet)` for every 16 bytes from '<' to '>'.
  template <class Each>
  void feed(std::span<const std::uint8_t> bytes, Each&& each) noexcept {
    for (const std::uint8_t byte : bytes) {
      if (held_ == 0 && byte != '<') {
        ++skipped_;
        continue;
      }
      // A '<' inside a packet is the beginning of one: bytes of the first were lost.
      if (byte == '<' && held_ > 0) {
        skipped_ += held_;
        held_ = 0;
      }
      packet_[held_++] = byte;
      if (held_ < packet_.size()) continue;
      held_ = 0;
      if (byte == '>')
        each(packet_);
      else
        skipped_ += packet_.size();
    }
  }
  void restart() noexcept { held_ = 0; }
  /// Bytes that belonged to no packet.
  std::uint64_t skipped() const noexcept { return skipped_; }

 private:
  FalconPacket packet_{};
  std::size_t held_ = 0;
  std::uint64_t skipped_ = 0;
};

}  // namespace tangent
