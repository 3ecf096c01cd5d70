// Writes every packet of a link to a text file, so that an owner of the hardware can send evidence of what it does.
//
// One line a packet: seconds since the start, direction (in, out, control), status, byte count, bytes in hexadecimal.
// The link's thread puts packets into a ring; a thread of its own writes them.
#pragma once

#include "devices/base/ring.h"
#include "devices/usb/usb_link.h"

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

namespace tangent {

class PacketRecorder final : public UsbTap {
 public:
  static Result<std::unique_ptr<PacketRecorder>> create(const std::filesystem::path& file);
  /// Writes what is left. After the link has stopped.
  ~PacketRecorder() override;
  PacketRecorder(const PacketRecorder&) = delete;
  PacketRecorder& operator=(const PacketRecorder&) = delete;

  void packet(Direction direction, std::int64_t time_ns, std::span<const std::uint8_t> bytes,
              int status) noexcept override;
  std::uint64_t drops() const noexcept { return ring_.drops(); }

 private:
  struct Packet {
    std::int64_t time_ns = 0;
    int status = 0;
    Direction direction = Direction::in;
    std::uint8_t length = 0;
    std::array<std::uint8_t, kUsbPacketBytes> bytes{};
  };
  explicit PacketRecorder(std::FILE* file);
  void write_all();

  std::FILE* file_;
  std::int64_t started_ns_;
  Ring<Packet> ring_{8192};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace tangent
