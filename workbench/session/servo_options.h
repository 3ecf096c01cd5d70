// Options of the servo and the status it reports.
#pragma once

#include "core/base/result.h"
#include "devices/safety_gate.h"
#include "workbench/session/exchange_watch.h"

#include <array>
#include <cstdint>
#include <string>

namespace tangent {

inline constexpr double kSlowestServoHz = 100.0;
inline constexpr double kFastestServoHz = 10'000.0;

struct ServoOptions {
  double rate_hz = 1000.0;  ///< kSlowestServoHz to kFastestServoHz
  bool realtime = true;     ///< request SCHED_FIFO and locked memory; runs without if refused
  int fifo_priority = 40;
  int cpu = -1;  ///< core for the servo's thread alone; -1: any
  /// Tick time for solver and devices. true: the deadlines (real devices); false: tick / rate (simulated devices, so
  /// that N ticks give identical results however late they ran).
  bool time_by_deadlines = false;
  bool watch_exchanges = false;     ///< of real devices: a thread that notices one that doesn't return
  double longest_stop_s = 1.0;      ///< what a person may wait for a device that does not return (Servo::stop)
  std::size_t ring_records = 8192;  ///< of each ring
};

/// What the operating system granted.
struct RealtimeGrant {
  bool fifo = false;
  bool memory_locked = false;
  bool on_cpu = false;  ///< on the core that was asked for
};

/// Counters of the servo. Each is consistent by itself; together they are not a snapshot of one instant.
struct ServoStatus {
  bool running = false;
  double nominal_hz = 0.0;
  double rate_hz = 0.0;  ///< measured over about the last second; 0 before that
  std::uint64_t ticks = 0;
  std::uint64_t late_ticks = 0;        ///< ticks right after at least one missed deadline
  std::uint64_t missed_deadlines = 0;  ///< skipped
  std::uint64_t gui_drops = 0;         ///< records dropped because the GUI's ring was full
  std::uint64_t recorder_drops = 0;
  double tick_mean_ns = 0.0, tick_p50_ns = 0.0, tick_p99_ns = 0.0, tick_p999_ns = 0.0;  ///< percentiles to 1/32
  double tick_worst_ns = 0.0;
  double lateness_worst_ns = 0.0, lateness_p99_ns = 0.0;
  std::uint32_t preset_id = 0;  ///< applied
  std::uint32_t scene_id = 0;   ///< applied
  GateState gate_state = GateState::disarmed;
  GateFault gate_fault = GateFault::none;
  std::array<std::uint64_t, kGateActionCount> gate_counts{};
  std::uint64_t gate_faults = 0;
  RealtimeGrant realtime;
  ExchangeWith hung = ExchangeWith::none;  ///< device whose exchange did not return in time
  bool hung_was_stopped = false;           ///< it had a way to be told to stop
};

}  // namespace tangent
