// Memory for a scene of millions of triangles, whose arrays are built one from another.
#pragma once

namespace tangent {

/// While one exists, memory that was freed is taken again instead of given back: fresh pages from the system, zeroed
/// one by one, are an eighth of the time in which five million triangles are opened. Of the whole process, so one at a
/// time; the last gives back what is free.
class KeptMemory {
 public:
  KeptMemory();
  ~KeptMemory();
  KeptMemory(const KeptMemory&) = delete;
  KeptMemory& operator=(const KeptMemory&) = delete;
};

}  // namespace tangent
