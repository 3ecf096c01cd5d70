// Counters written by the servo thread and read by any thread. Relaxed atomics: each is consistent by itself.
#pragma once

#include "devices/base/log_histogram.h"
#include "workbench/session/servo_options.h"
#include "workbench/session/servo_record.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace tangent {

class ServoStatistics {
 public:
  /// Servo thread, once per tick.
  void add(const ServoRecord& record, const SafetyGate& gate) noexcept;
  /// Servo thread, at the start of a tick (`now_ns`): measures the rate over about a second.
  void note_start(std::int64_t now_ns) noexcept;
  /// Servo thread, or while it is not running.
  void restart_rate() noexcept { window_start_ns_ = 0; }

  /// Any thread may read these three.
  const LogHistogram& lateness_ns() const { return lateness_ns_; }
  const LogHistogram& period_ns() const { return period_ns_; }
  const LogHistogram& latency_ns() const { return latency_ns_; }

  /// Any thread. Fills the fields that are counted here.
  void fill(ServoStatus& status) const noexcept;

 private:
  template <class T>
  static void raise(std::atomic<T>& counter, T by) noexcept {
    counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
  }
  static void keep_largest(std::atomic<double>& worst, double value) noexcept {
    if (value > worst.load(std::memory_order_relaxed)) worst.store(value, std::memory_order_relaxed);
  }

  std::atomic<std::uint64_t> ticks_{0}, late_ticks_{0}, missed_deadlines_{0}, gate_faults_{0};
  std::atomic<double> tick_sum_ns_{0.0}, tick_worst_ns_{0.0}, lateness_worst_ns_{0.0}, rate_hz_{0.0};
  std::atomic<std::uint32_t> preset_id_{0}, scene_id_{0};
  std::atomic<GateState> gate_state_{GateState::disarmed};
  std::atomic<GateFault> gate_fault_{GateFault::none};
  std::array<std::atomic<std::uint64_t>, kGateActionCount> gate_counts_{};
  LogHistogram tick_ns_, lateness_ns_, period_ns_, latency_ns_;
  std::int64_t window_start_ns_ = 0;  // servo thread only
  std::uint64_t window_ticks_ = 0;
};

}  // namespace tangent
