#include "devices/falcon/falcon_codec.h"

namespace tangent {

namespace {

constexpr std::uint8_t kZero = 0x41;  // 'A'
constexpr std::size_t kFlags = 13, kUnused = 14, kLast = 15;

using Numbers = std::array<std::int16_t, 3>;

FalconPacket framed(const Numbers& numbers, unsigned flags) noexcept {
  FalconPacket packet{};
  packet.front() = '<';
  for (std::size_t i = 0; i < 12; ++i) {
    const auto bits = static_cast<std::uint16_t>(numbers[i / 4]);
    packet[1 + i] = static_cast<std::uint8_t>(kZero + (bits >> (4 * (i % 4)) & 15u));
  }
  packet[kFlags] = static_cast<std::uint8_t>(kZero + flags);
  packet[kUnused] = kZero;
  packet[kLast] = '>';
  return packet;
}

bool unframed(std::span<const std::uint8_t, kFalconPacketBytes> bytes, Numbers& numbers, unsigned& flags) noexcept {
  if (bytes.front() != '<' || bytes[kLast] != '>' || bytes[kFlags] < kZero) return false;
  flags = bytes[kFlags] - unsigned{kZero};
  for (std::size_t i = 0; i < 3; ++i) {
    unsigned bits = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      const unsigned byte = bytes[1 + 4 * i + j];
      if (byte < kZero || byte > kZero + 15u) return false;
      bits |= (byte - kZero) << (4 * j);
    }
    numbers[i] = static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
  }
  return true;
}

}  // namespace

FalconPacket to_packet(const FalconCommand& command) noexcept {
  return framed(command.torque, unsigned{command.homing} | (command.lamps & 0x0eu));
}

FalconPacket to_packet(const FalconAnswer& answer) noexcept {
  return framed(answer.encoder, (answer.buttons & 15u) | (answer.homed & 7u) << 4);
}

std::optional<FalconAnswer> to_answer(std::span<const std::uint8_t, kFalconPacketBytes> bytes) noexcept {
  FalconAnswer answer;
  unsigned flags = 0;
  if (!unframed(bytes, answer.encoder, flags) || flags > 0x7fu) return std::nullopt;
  answer.buttons = static_cast<std::uint8_t>(flags & 15u);
  answer.homed = static_cast<std::uint8_t>(flags >> 4);
  return answer;
}

std::optional<FalconCommand> to_command(std::span<const std::uint8_t, kFalconPacketBytes> bytes) noexcept {
  FalconCommand command;
  unsigned flags = 0;
  if (!unframed(bytes, command.torque, flags) || flags > 0x0fu) return std::nullopt;
  command.homing = (flags & 1u) != 0;
  command.lamps = static_cast<std::uint8_t>(flags & 0x0eu);
  return command;
}

std::span<const std::uint8_t> ftdi_payload(std::span<const std::uint8_t> packet) noexcept {
  constexpr std::size_t kStatusBytes = 2;
  return packet.size() <= kStatusBytes ? std::span<const std::uint8_t>() : packet.subspan(kStatusBytes);
}

}  // namespace tangent
