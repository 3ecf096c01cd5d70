#include "workbench/session/servo_statistics.h"

namespace tangent {

namespace {

constexpr auto kRelaxed = std::memory_order_relaxed;
constexpr std::int64_t kRateWindowNs = 1'000'000'000;

}  // namespace

void ServoStatistics::note_start(std::int64_t now_ns) noexcept {
  if (window_start_ns_ == 0) {
    window_start_ns_ = now_ns;
    window_ticks_ = 0;
    return;
  }
  ++window_ticks_;
  const std::int64_t elapsed = now_ns - window_start_ns_;
  if (elapsed < kRateWindowNs) return;
  rate_hz_.store(static_cast<double>(window_ticks_) * 1e9 / static_cast<double>(elapsed), kRelaxed);
  window_start_ns_ = now_ns;
  window_ticks_ = 0;
}

void ServoStatistics::add(const ServoRecord& record, const SafetyGate& gate) noexcept {
  raise(ticks_, std::uint64_t{1});
  raise(missed_deadlines_, std::uint64_t{record.missed_deadlines});
  if (record.missed_deadlines > 0) raise(late_ticks_, std::uint64_t{1});
  raise(tick_sum_ns_, record.tick_ns);
  keep_largest(tick_worst_ns_, record.tick_ns);
  keep_largest(lateness_worst_ns_, record.lateness_ns);
  tick_ns_.add(static_cast<std::uint64_t>(record.tick_ns));
  lateness_ns_.add(static_cast<std::uint64_t>(record.lateness_ns));
  if (record.period_ns > 0.0) period_ns_.add(static_cast<std::uint64_t>(record.period_ns));
  if (record.latency_ns > 0.0) latency_ns_.add(static_cast<std::uint64_t>(record.latency_ns));
  preset_id_.store(record.tick.preset_id, kRelaxed);
  scene_id_.store(record.scene_id, kRelaxed);
  gate_state_.store(gate.state(), kRelaxed);
  gate_fault_.store(gate.fault(), kRelaxed);
  gate_faults_.store(gate.faults(), kRelaxed);
  for (std::size_t i = 0; i < kGateActionCount; ++i) gate_counts_[i].store(gate.counts()[i], kRelaxed);
}

void ServoStatistics::fill(ServoStatus& status) const noexcept {
  status.rate_hz = rate_hz_.load(kRelaxed);
  status.ticks = ticks_.load(kRelaxed);
  status.late_ticks = late_ticks_.load(kRelaxed);
  status.missed_deadlines = missed_deadlines_.load(kRelaxed);
  status.tick_mean_ns = status.ticks > 0 ? tick_sum_ns_.load(kRelaxed) / static_cast<double>(status.ticks) : 0.0;
  status.tick_p50_ns = tick_ns_.percentile(0.5);
  status.tick_p99_ns = tick_ns_.percentile(0.99);
  status.tick_p999_ns = tick_ns_.percentile(0.999);
  status.tick_worst_ns = tick_worst_ns_.load(kRelaxed);
  status.lateness_worst_ns = lateness_worst_ns_.load(kRelaxed);
  status.lateness_p99_ns = lateness_ns_.percentile(0.99);
  status.preset_id = preset_id_.load(kRelaxed);
  status.scene_id = scene_id_.load(kRelaxed);
  status.gate_state = gate_state_.load(kRelaxed);
  status.gate_fault = gate_fault_.load(kRelaxed);
  status.gate_faults = gate_faults_.load(kRelaxed);
  for (std::size_t i = 0; i < kGateActionCount; ++i) status.gate_counts[i] = gate_counts_[i].load(kRelaxed);
}

}  // namespace tangent
