#include "workbench/session/compare_presets.h"

#include "workbench/session/replay_ticks.h"
#include "workbench/session/run_counter.h"

#include <array>
#include <utility>

namespace tangent {

namespace {

/// Ticks that one preset solves before it is the other's turn.
constexpr std::size_t kTurn = 64;

std::size_t begin_of_chunk(std::size_t chunk) {
  const std::size_t begin = chunk * HistoryResolver::kChunk;
  return begin > HistoryResolver::kLeadIn ? begin - HistoryResolver::kLeadIn : 0;
}

}  // namespace

RunPart part_of(const RecordedRun& run, std::size_t begin, std::size_t end) {
  const std::size_t lead = begin / HistoryResolver::kChunk * HistoryResolver::kChunk;
  RunPart part{run, begin - lead};
  part.run.records = run.records.slice(lead, end);
  return part;
}

struct PresetComparison::Summary {
  std::array<RunCounter, 2> counts;
  std::array<std::int64_t, 2> ns{};
  std::array<std::uint64_t, 2> stepped{};
  std::vector<ContactChange> changes;
  std::uint64_t changed = 0;
};

PresetComparison::PresetComparison(RecordedRun run, std::size_t first, const Preset& before, const Preset& after,
                                   bool timed)
    : run_(std::move(run)), first_(first), before_(before), after_(after), timed_(timed) {
  summaries_.resize(chunk_count());
}

PresetComparison::~PresetComparison() = default;

std::size_t PresetComparison::chunk_count() const {
  return (run_.records.size() + HistoryResolver::kChunk - 1) / HistoryResolver::kChunk;
}

void PresetComparison::solve_chunk(std::size_t chunk) {
  const std::size_t end = std::min((chunk + 1) * HistoryResolver::kChunk, run_.records.size());
  const std::size_t counted = std::max(first_, chunk * HistoryResolver::kChunk);
  Summary& summary = summaries_[chunk];
  const double tolerance = std::max(before_.solver.tolerance_m, after_.solver.tolerance_m);
  std::array<ReplayTicks, 2> replays{ReplayTicks(run_, &before_, false), ReplayTicks(run_, &after_, false)};
  std::array<std::array<std::optional<TickOutput>, kTurn>, 2> outputs;
  if (counted >= end) return;
  for (std::size_t begin = begin_of_chunk(chunk); begin < end; begin += kTurn) {
    const std::size_t turn_end = std::min(begin + kTurn, end);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t side = (begin / kTurn + k) % 2;  // each goes first every other time
      const std::int64_t began = timed_ ? processor_ns() : 0;
      bool taken_over = false;
      for (std::size_t i = begin; i < turn_end; ++i) {
        outputs[side][i - begin] = replays[side].step(run_.records[i], taken_over);
        summary.stepped[side] += outputs[side][i - begin].has_value();
      }
      if (timed_) summary.ns[side] += processor_ns() - began;
    }
    for (std::size_t i = std::max(begin, counted); i < turn_end; ++i) {
      const auto &was = outputs[0][i - begin], &is = outputs[1][i - begin];
      if (!was || !is) continue;
      summary.counts[0].add(was->status, was->error_m, was->iterations);
      summary.counts[1].add(is->status, is->error_m, is->iterations);
      if (!contact_changed(*was, *is, tolerance)) continue;
      ++summary.changed;
      const std::uint64_t tick = run_.records[i].tick.tick;
      append_change(summary.changes,
                    {tick, tick, tick, glm::length(is->contact - was->contact), was->status, is->status, 1});
    }
  }
}

PresetsCompared PresetComparison::finish() {
  PresetsCompared out;
  out.before = before_;
  out.after = after_;
  if (first_ < run_.records.size()) {
    out.from_tick = run_.records[first_].tick.tick;
    out.end_tick = run_.records.newest().tick.tick + 1;
  }
  std::array<RunCounter, 2> counts;
  std::array<std::int64_t, 2> ns{};
  std::array<std::uint64_t, 2> stepped{};
  for (const Summary& summary : summaries_) {
    for (std::size_t side = 0; side < 2; ++side) {
      counts[side].add(summary.counts[side]);
      ns[side] += summary.ns[side];
      stepped[side] += summary.stepped[side];
    }
    out.changed_ticks += summary.changed;
    for (const ContactChange& change : summary.changes) append_change(out.changes, change);
  }
  const auto mean_ns = [&](std::size_t side) {
    return stepped[side] > 0 ? static_cast<double>(ns[side]) / static_cast<double>(stepped[side]) : 0.0;
  };
  out.before_numbers = counts[0].done();
  out.after_numbers = counts[1].done();
  out.before_ns = mean_ns(0);
  out.after_ns = mean_ns(1);
  return out;
}

std::optional<TickOutput> trace_resolved_tick(const RecordedRun& run, const Preset& preset, std::size_t index,
                                              IterationTrace& trace) {
  ReplayTicks replay(run, &preset);
  bool taken_over = false;
  for (std::size_t i = begin_of_chunk(index / HistoryResolver::kChunk); i < index; ++i)
    static_cast<void>(replay.step(run.records[i], taken_over));
  trace.clear();
  return replay.step(run.records[index], taken_over, &trace);
}

}  // namespace tangent
