// A whole file, or a pipe to its end, as text.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace tangent {

/// A line of more characters is no table's and no preset's.
inline constexpr std::size_t kLongestLine = std::size_t{1} << 16;

/// What a pipe may bring: a program that never ends may write valid lines, too. As much as 1.5 hours of poses at 1 kHz.
inline constexpr std::size_t kMostPipedBytes = std::size_t{1} << 28;

/// Fails, naming the path and the system's reason, when it can't be read, is empty, or holds more than `max_bytes` (a
/// file that says so is not read at all), through a pipe or from a device `max_piped_bytes`; at the first zero byte and
/// the first line above kLongestLine, naming the line, without reading on: a device that never ends has either. Memory
/// grows with what is read, not with a promised size.
Result<std::string> read_input_file(const std::filesystem::path& path, std::size_t max_bytes,
                                    std::size_t max_piped_bytes = kMostPipedBytes);

}  // namespace tangent
