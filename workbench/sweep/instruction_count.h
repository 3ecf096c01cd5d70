// Instructions that this thread runs, counted by the processor where it and the system let us: a cost that does not
// change with what else the machine does.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace tangent::sweep {

/// Of `work`, in user mode. Empty: this machine does not count (no such counter, as in most virtual machines, or
/// kernel.perf_event_paranoid forbids it); `work` was run all the same.
std::optional<std::uint64_t> count_instructions(const std::function<void()>& work);

}  // namespace tangent::sweep
