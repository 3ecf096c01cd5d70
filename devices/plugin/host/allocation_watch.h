// Counts the allocations of the thread that asks for it: those of malloc and its kin, whoever calls them.
#pragma once

#include <atomic>
#include <cstdint>

namespace tangent {

/// From now on, on this thread.
void count_allocations() noexcept;
/// Until now; how many there were.
std::uint64_t counted_allocations() noexcept;

/// From now on, of every thread: those that got no memory are counted here. Not under sanitizers, which end the process
/// then.
void count_refusals(std::atomic<std::uint32_t>& here) noexcept;

}  // namespace tangent
