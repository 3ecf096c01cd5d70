#include "workbench/report/recording_summary.h"

#include "core/lab/explain/explain_tick.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

double magnitude(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

/// Adds one tick after the other to a summary.
class Summing {
 public:
  Summing(RecordingSummary& sum, const RecordingInfo& info)
      : sum_(sum), info_(info), spectrum_(info.rate_hz() > 0.0 ? info.rate_hz() : 1000.0) {
    sum.parts.resize(RecordingSummary::kParts);
  }

  void add(const RecordedTick& recorded) {
    const TickRecord& tick = recorded.record.tick;
    add_contact(tick);
    add_trouble(tick);
    add_servo(recorded.record);
    use(sum_.presets[tick.preset_id], tick);
    use(sum_.scenes[recorded.record.scene_id], tick);
    draw(recorded);
    spectrum_.add(tick.output.force_n, tick.output.cld_m, has_last_ && tick.tick == last_.tick + 1);
    last_ = tick;
    has_last_ = true;
  }

  void finish() {
    if (sum_.ticks == 0) return;
    const auto count = static_cast<double>(sum_.ticks);
    sum_.mean_planes = planes_ / count;
    sum_.spectrum = spectrum_.done();
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < by_planes_.size(); ++i) {
      below += by_planes_[i];
      if (static_cast<double>(below) < 0.99 * count) continue;
      sum_.p99_planes = static_cast<double>(i);
      break;
    }
  }

 private:
  void add_contact(const TickRecord& tick) {
    const TickOutput& out = tick.output;
    ++sum_.ticks;
    ++sum_.statuses[static_cast<std::size_t>(out.status)];
    ++sum_.events[static_cast<std::size_t>(out.event)];
    const bool follows = has_last_ && tick.tick == last_.tick + 1;
    if (follows && touches(last_.output)) sum_.contact_s += tick.input.t_s - last_.input.t_s;
    sum_.touching += touches(out) ? 1 : 0;
    if (is_converged(out.status)) sum_.worst_error_m = std::max(sum_.worst_error_m, out.error_m);
    if (touches(out)) sum_.deepest_m = std::max(sum_.deepest_m, out.penetration_m);
    sum_.most_force_n = std::max(sum_.most_force_n, magnitude(out.force_n));
    planes_ += out.iterations;
    sum_.most_planes = std::max<std::int64_t>(sum_.most_planes, out.iterations);
    ++by_planes_[static_cast<std::size_t>(std::clamp(out.iterations, 0, 4095))];
  }

  void add_trouble(const TickRecord& tick) {
    const std::optional<TickTrouble> trouble = trouble_of(tick.output);
    if (!trouble) return;
    WorstTick& worst = sum_.worst[static_cast<std::size_t>(*trouble)];
    ++worst.count;
    double size = tick.output.error_m;
    if (*trouble == TickTrouble::many_planes) size = tick.output.iterations;
    if (*trouble == TickTrouble::reseed || *trouble == TickTrouble::deeper || *trouble == TickTrouble::branch)
      size = has_last_ ? magnitude(tick.output.decided_force_n - last_.output.decided_force_n) : 0.0;
    if (!(size > worst.size)) return;
    worst.tick = tick.tick;
    worst.t_s = tick.input.t_s;
    worst.size = size;
  }

  void add_servo(const ServoRecord& record) {
    sum_.missed_deadlines += record.missed_deadlines;
    if (record.period_ns > 0.0) sum_.period.add(record.period_ns);
    if (record.tick_ns > 0.0) sum_.tick.add(record.tick_ns);
    if (record.tick_ns > 0.0) sum_.late.add(std::max(0.0, record.lateness_ns));
    if (record.tick.solve_ns > 0.0) sum_.solve.add(record.tick.solve_ns);
    if (record.latency_ns > 0.0) sum_.latency.add(record.latency_ns);
    const DeviceTelemetry& device = record.device;
    for (std::size_t i = 0; i < kGateActionCount; ++i) sum_.gate_actions[i] += (device.gate_actions >> i) & 1u;
    sum_.armed += device.gate_state == GateState::armed || device.gate_state == GateState::ramping ? 1 : 0;
    sum_.gate_faulted += device.gate_state == GateState::faulted ? 1 : 0;
    const bool faulted = device.force_state == DeviceState::faulted || device.display_state == DeviceState::faulted;
    sum_.device_faulted += faulted ? 1 : 0;
  }

  void draw(const RecordedTick& recorded) {
    const TickRecord& tick = recorded.record.tick;
    const TickOutput& out = tick.output;
    const std::uint64_t span = info_.last_tick - info_.first_tick + 1;
    const std::uint64_t at = (tick.tick - info_.first_tick) * RecordingSummary::kParts / span;
    sum_.parts[std::min<std::size_t>(at, RecordingSummary::kParts - 1)].include(
        tick.input.t_s,
        {magnitude(out.force_n), magnitude(recorded.record.device.force_command_n), out.penetration_m, out.cld_m,
         recorded.record.device.cld_command_m, out.error_m, static_cast<double>(out.iterations)});
  }

  static bool touches(const TickOutput& out) { return is_converged(out.status) && out.status != TickStatus::free; }
  static void use(RecordingSummary::Use& use, const TickRecord& tick) {
    if (use.ticks++ != 0) return;
    use.first_tick = tick.tick;
    use.first_s = tick.input.t_s;
  }

  RecordingSummary& sum_;
  const RecordingInfo& info_;
  TickRecord last_;
  bool has_last_ = false;
  double planes_ = 0.0;
  std::array<std::uint64_t, 4096> by_planes_{};
  SpectrumCounter spectrum_;
};

}  // namespace

const char* to_string(TickTrouble trouble) {
  switch (trouble) {
    case TickTrouble::unconverged:
      return "not converged";
    case TickTrouble::facing:
      return "no contact offered (facing)";
    case TickTrouble::reseed:
      return "tracking lost (reseed)";
    case TickTrouble::deeper:
      return "deeper place took over (switch)";
    case TickTrouble::branch:
      return "solution folded (branch)";
    case TickTrouble::many_planes:
      return "more than 8 planes";
  }
  return "?";
}

std::optional<TickTrouble> trouble_of(const TickOutput& output) {
  if (output.status == TickStatus::facing) return TickTrouble::facing;
  if (!is_converged(output.status)) return TickTrouble::unconverged;
  switch (output.event) {
    case TickEvent::reseed:
      return TickTrouble::reseed;
    case TickEvent::switched:
      return TickTrouble::deeper;
    case TickEvent::branch:
      return TickTrouble::branch;
    case TickEvent::first:
      return std::nullopt;
    case TickEvent::none:
      break;
  }
  return output.iterations > ExplainOptions{}.many_planes ? std::optional(TickTrouble::many_planes) : std::nullopt;
}

void TimeSpread::add(double ns) {
  spread.add(ns);
  ++count;
  most_ns = std::max(most_ns, ns);
}

double TimeSpread::quantile_ns(double q) const {
  constexpr double kHalfBin = 1.011;  // of Spread: 1/64 of an octave
  const double ns = spread.quantile(q);
  return kHalfBin * ns >= most_ns ? most_ns : ns;
}

void TimePart::include(double t_s, const std::array<double, kDrawn>& values) {
  if (ticks++ == 0) {
    from_s = t_s;
    least = most = values;
  }
  to_s = t_s;
  for (std::size_t i = 0; i < kDrawn; ++i) {
    if (!(values[i] >= least[i])) least[i] = values[i];
    if (!(values[i] <= most[i])) most[i] = values[i];
  }
}

Result<RecordingSummary> summarise(Recording& recording, const std::function<bool()>& cancelled) {
  RecordingSummary sum;
  if (recording.info().ticks == 0) return sum;
  Result<TickReader> ticks = recording.ticks(recording.info().first_tick, recording.info().last_tick);
  if (!ticks) return tl::unexpected(ticks.error());
  Summing summing(sum, recording.info());
  for (RecordedTick tick;;) {
    const Result<bool> any = ticks->next(tick);
    if (!any) return tl::unexpected(any.error());
    if (!*any) break;
    if (sum.ticks % 4096 == 0 && cancelled()) return fail("interrupted", recording.path().string());
    summing.add(tick);
  }
  summing.finish();
  return sum;
}

}  // namespace tangent
