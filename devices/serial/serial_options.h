// Options of the serial force device.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tangent {

/// CLOCK_MONOTONIC in nanoseconds.
std::int64_t serial_now_ns() noexcept;

struct SerialForceOptions {
  std::string port;                    ///< path; empty: the only one that is attached
  int baud = 1000000;                  ///< one of serial_bauds; to USB CDC it means nothing
  std::filesystem::path dev = "/dev";  ///< where ports are
  std::int64_t (*now_ns)() noexcept = serial_now_ns;
  bool realtime = true;     ///< the line's thread asks for SCHED_FIFO
  double answer_s = 3.0;    ///< open waits so long for an answer; boards that reset when opened take 2 s
  double silence_s = 0.01;  ///< no sample for this long: fault `disconnected`
  double reopen_s = 0.2;    ///< between two looks for an unplugged device
};

}  // namespace tangent
