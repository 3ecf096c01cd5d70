#include "workbench/session/kept_memory.h"

#include <malloc.h>

namespace tangent {

// Blocks of their own, as large ones have by default, go back to the system when they are freed.
KeptMemory::KeptMemory() {
  constexpr int kNoBlocks = 0, kNever = -1;
  ::mallopt(M_MMAP_MAX, kNoBlocks);
  ::mallopt(M_TRIM_THRESHOLD, kNever);
}

// As the C library begins, with the largest thresholds that it would come to by itself.
KeptMemory::~KeptMemory() {
  constexpr int kManyBlocks = 65536, kLargest = 32 << 20;
  ::mallopt(M_MMAP_MAX, kManyBlocks);
  ::mallopt(M_MMAP_THRESHOLD, kLargest);
  ::mallopt(M_TRIM_THRESHOLD, 2 * kLargest);
  ::malloc_trim(0);
}

}  // namespace tangent
