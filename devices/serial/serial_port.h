// One serial port, opened for this program alone: raw, non-blocking, locked. POSIX; errors are errno's.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tangent {

/// Lines per second that Linux knows, 115200 to 4000000. To USB CDC the number means nothing; converters use it.
const std::vector<int>& serial_bauds();

/// What errno says about opening this port: what is wrong, and what to do.
Error serial_error(int error_number, const std::string& path);

class SerialPort {
 public:
  SerialPort() = default;
  ~SerialPort() { close(); }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// 0, or an error number: EBUSY when another program has it, ENOTTY when it is no serial port, EINVAL for a rate that
  /// is none of serial_bauds.
  int open(const char* path, int baud) noexcept;
  void close() noexcept;
  bool is_open() const noexcept { return fd_ >= 0; }
  int fd() const noexcept { return fd_; }

  /// Bytes read; 0: none are there; -1: the port is gone.
  int read(std::span<std::uint8_t> out) noexcept;
  /// Bytes taken, fewer than given when the line is full; -1: the port is gone.
  int write(std::span<const std::uint8_t> bytes) noexcept;
  /// Bytes that the system has taken and not yet sent; 0 where it does not know.
  int unsent() const noexcept;
  /// Drops those.
  void drop_unsent() noexcept;

 private:
  int fd_ = -1;
  bool locked_ = false;  ///< by this object: of another program's lock nothing is taken away
};

}  // namespace tangent
