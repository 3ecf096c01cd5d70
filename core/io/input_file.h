// A whole file, or a pipe to its end, as text.
#pragma once

#include "core/base/result.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace tangent {

/// Fails, naming the path and the system's reason, when it can't be read, is empty, or has more than `max_bytes`.
/// Memory grows with the bytes read, not with a stated size.
Result<std::string> read_input_file(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace tangent
