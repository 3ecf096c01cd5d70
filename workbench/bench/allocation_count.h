// Number of heap allocations (operator new) of this thread. Counted in programs that link tangent_allocation_counter;
// zero in all others.
#pragma once

#include <cstdint>

namespace tangent {

struct AllocationCount {
  bool counted = false;     ///< false: this program does not count
  std::uint64_t count = 0;  ///< of the calling thread, since it started
};
AllocationCount allocation_count() noexcept;

}  // namespace tangent
