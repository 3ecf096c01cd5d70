// Counts the allocations of the thread that asks for it: those of malloc and its kin, whoever calls them.
#pragma once

#include <cstdint>

namespace tangent {

/// From now on, on this thread.
void count_allocations() noexcept;
/// Until now; how many there were.
std::uint64_t counted_allocations() noexcept;

}  // namespace tangent
