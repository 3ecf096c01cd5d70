// A whole file, or a pipe to its end, as text.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace tangent {

/// A line of more characters is no table's and no preset's.
inline constexpr std::size_t kLongestLine = std::size_t{1} << 16;

/// Of what is no regular file.
struct PipeLimits {
  /// A program that never ends may write valid lines, too. As much as 1.5 hours of poses at 1 kHz.
  std::size_t max_bytes = std::size_t{1} << 28;
  /// A named pipe that nobody opens for writing so long is given up: it was read to its end before, or never written
  /// to. Who has opened it may take any time.
  int wait_for_writer_ms = 10'000;
};

/// Fails, naming the path and the system's reason, when it can't be read, is empty, or holds more than `max_bytes` (a
/// file that says so is not read at all), through a pipe or from a device more than `piped` allows; at the first zero
/// byte and the first line above kLongestLine, naming the line, without reading on: a device that never ends has
/// either. Memory grows with what is read, not with a promised size.
Result<std::string> read_input_file(const std::filesystem::path& path, std::size_t max_bytes,
                                    const PipeLimits& piped = {});

/// Every read_input_file that waits for a pipe, now or later, fails as interrupted, until allow_waiting(). From a
/// signal handler, too.
void end_waiting_for_input() noexcept;
void allow_waiting_for_input() noexcept;

}  // namespace tangent
