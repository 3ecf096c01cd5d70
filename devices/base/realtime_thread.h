// Scheduling of a driver's own thread, which the servo's tick depends on.
#pragma once

namespace tangent {

/// The servo's own (workbench/session/servo_options.h), for what answers within its tick.
inline constexpr int kServoPriority = 40;
/// For what talks to a device beside it: on one core the servo goes first.
inline constexpr int kLinkPriority = 39;

/// The calling thread: SCHED_FIFO at `priority` and timers without slack. False: the system refused the first, and the
/// thread goes on as it was.
bool ask_for_realtime(int priority) noexcept;

}  // namespace tangent
