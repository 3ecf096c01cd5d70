// A whole file in memory, for the mesh readers.
#pragma once

#include "core/base/result.h"
#include "core/base/run_both.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace tangent {

/// The bytes of a file, followed by one '\n' and one '\0' that are not counted: text readers may look
/// one character past any they have accepted, and every line ends.
struct FileBytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;

  const char* begin() const { return data.get(); }
  const char* end() const { return data.get() + size; }
  std::string_view view() const { return {data.get(), size}; }
};

/// Reads a regular file. Fails when it is missing, not a regular file, unreadable, empty or larger
/// than 64 GiB or the machine's memory. `run_both` may read its halves at once.
Result<FileBytes> read_file_bytes(const std::filesystem::path& path, const RunBoth& run_both = run_in_turn);

}  // namespace tangent
