// A tick of a recording, by its file.
#pragma once

#include <cstdint>
#include <filesystem>

namespace tangent {

struct RecordedPlace {
  std::filesystem::path file;
  std::uint64_t tick = 0;
};

}  // namespace tangent
