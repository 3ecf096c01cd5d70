// Logs every packet of a link to a text file, for bug reports from owners of the hardware.
//
// One line per packet: seconds since the start, direction (in, out, control), status, byte count, bytes in hexadecimal.
// The link's thread pushes packets into a ring; the recorder's own thread writes them.
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
  /// Fails when the file can't be written, its first line included.
  static Result<std::unique_ptr<PacketRecorder>> create(const std::filesystem::path& file);
  /// Writes the rest of the ring. Precondition: the link has stopped.
  ~PacketRecorder() override;
  PacketRecorder(const PacketRecorder&) = delete;
  PacketRecorder& operator=(const PacketRecorder&) = delete;

  /// Link's thread. Copies at most kUsbPacketBytes; counts a drop when the ring is full.
  void packet(Direction direction, std::int64_t time_ns, std::span<const std::uint8_t> bytes,
              int status) noexcept override;
  /// Packets lost because the ring was full. Any thread.
  std::uint64_t drops() const noexcept { return ring_.drops(); }
  /// Fails when something that should be in the file is not: the disk is full, or packets were lost. Any thread.
  Status complete() const;

 private:
  struct Packet {
    std::int64_t time_ns = 0;
    int status = 0;
    Direction direction = Direction::in;
    std::uint8_t length = 0;
    std::array<std::uint8_t, kUsbPacketBytes> bytes{};
  };
  PacketRecorder(std::FILE* file, std::filesystem::path path);
  void write_all();

  std::FILE* file_;
  const std::filesystem::path path_;
  std::atomic<int> failed_{0};  ///< errno of the first write that failed
  std::int64_t started_ns_;
  Ring<Packet> ring_{8192};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace tangent
