// Memory for a scene of millions of triangles, whose arrays are built one from another.
#pragma once

#include <cstddef>
#include <filesystem>

namespace tangent {

/// While one exists, memory that was freed is taken again instead of given back: fresh pages from the system, zeroed
/// one by one, are an eighth of the time in which five million triangles are opened, and on some virtual machines half.
/// Of the whole process, so one at a time; the last gives back what is free.
class KeptMemory {
 public:
  /// `beforehand`: so many bytes are taken at once, as large pages where the system has them, which takes it a fiftieth
  /// to a half of the time of one by one. At most half of what is free.
  explicit KeptMemory(std::size_t beforehand = 0);
  ~KeptMemory();
  KeptMemory(const KeptMemory&) = delete;
  KeptMemory& operator=(const KeptMemory&) = delete;
};

/// About as many bytes as it takes to open a mesh; 0 for a small file, or none.
std::size_t memory_to_open(const std::filesystem::path& mesh);

}  // namespace tangent
