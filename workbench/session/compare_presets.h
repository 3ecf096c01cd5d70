// Two presets over the same recorded ticks: both are solved, on the same motion, in turns, so that counts and times can
// be compared. The recording itself may span other presets and other load on the machine, so it is compared with
// neither.
#pragma once

#include "workbench/session/resolve_history.h"

#include <cstdint>
#include <vector>

namespace tangent {

/// A part of a recorded run, with the records before it from which solving it starts.
struct RunPart {
  RecordedRun run;
  std::size_t first = 0;  ///< index in run.records of the part's first record
};
/// Records begin ... end - 1, from the beginning of their chunk on (HistoryResolver::kChunk), so that ticks of the part
/// are solved as in the whole run. Precondition: begin < end <= run.records.size().
RunPart part_of(const RecordedRun& run, std::size_t begin, std::size_t end);

struct PresetsCompared {
  Preset before, after;
  std::uint64_t from_tick = 0, end_tick = 0;  ///< from the first to one past the last
  RunNumbers before_numbers, after_numbers;   ///< over the ticks that both could solve
  double before_ns = 0.0, after_ns = 0.0;     ///< processor time a tick; 0: not measured
  std::vector<ContactChange> changes;         ///< of `before` (there: recorded) to `after` (there: resolved)
  std::uint64_t changed_ticks = 0;
};

/// Solves chunks in any order and from any number of threads, each once.
class PresetComparison {
 public:
  /// Compares over the records from index `first` on; those before it are only led in from. Chunks are those of
  /// HistoryResolver over the same run, so that `after` gives its ticks.
  PresetComparison(RecordedRun run, std::size_t first, const Preset& before, const Preset& after, bool timed);
  ~PresetComparison();

  std::size_t chunk_count() const;
  /// Precondition: chunk < chunk_count(), and not solved yet.
  void solve_chunk(std::size_t chunk);
  /// Call once, after the last solve_chunk has returned.
  PresetsCompared finish();

 private:
  struct Summary;
  const RecordedRun run_;
  const std::size_t first_;
  const Preset before_, after_;
  const bool timed_;
  std::vector<Summary> summaries_;  ///< by chunk
};

/// The tick at `index` as HistoryResolver solves it under `preset`, with its iterations. Steps through its chunk up to
/// there. Empty: its scene is gone.
std::optional<TickOutput> trace_resolved_tick(const RecordedRun& run, const Preset& preset, std::size_t index,
                                              IterationTrace& trace);

}  // namespace tangent
