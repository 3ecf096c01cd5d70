// What the process of a plug-in may take from the machine, so that one that goes wrong takes nobody else with it. The
// limits are the kernel's (setrlimit): the plug-in can't lift them unless it runs as root and wants to.
#pragma once

#include <cstdint>

namespace tangent {

/// Private memory of this process, beyond what it has now; 0: as much as there is. Counted is what may be written and
/// is no file's or other process's: heap, stacks of threads, anonymous maps, data of libraries. What is mapped as
/// shared is not. Beyond it malloc gives none, and new throws. False: the kernel refused, and there is no limit.
///
/// Beyond what it has, since sanitizers map terabytes when the process begins.
bool limit_memory(std::uint64_t bytes) noexcept;

/// Processor time of a thread with real-time priority between two sleeps. Then comes SIGXCPU (crash_handler.h), a
/// little later SIGKILL: a loop without end must not keep the processor from the servo.
bool limit_realtime(double seconds) noexcept;

}  // namespace tangent
