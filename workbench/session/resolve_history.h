// Solves recorded ticks again under another preset, on the same motion.
//
// The hand moved under the recorded preset, so this compares solvers, not feel; the display of the result says "same
// motion assumed". Ticks are solved in independent chunks: a chunk starts kLeadIn ticks early from the recorded state
// and then carries its own state, as the servo does; it takes the recorded state again wherever ticks are missing or
// the scene changed. Under the recorded presets every tick gives identical results.
//
// Where a preset changes no value that the solver reads, the recorded contacts are taken over and only force and
// display are computed again. Without a preset everything is solved again, to verify the recording.
#pragma once

#include "workbench/session/session.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tangent {

/// One tick solved again. SI, world frame.
struct ResolvedTick {
  std::uint64_t tick = 0;
  float force_n[3] = {0.0f, 0.0f, 0.0f};
  float cld_m = 0.0f, error_m = 0.0f;
  float moved_m = 0.0f;  ///< distance from the recorded contact
  std::int32_t iterations = 0;
  TickStatus status = TickStatus::unconverged;
  bool contact_changed = false;  ///< see contact_changed()
  bool same_bits = false;        ///< identical to the recorded output
  bool solved = false;           ///< false: its scene is gone, or its chunk was not solved
};

/// A run of ticks whose contact changed, including gaps of a few ticks.
struct ContactChange {
  std::uint64_t first_tick = 0, last_tick = 0;
  std::uint64_t worst_tick = 0;  ///< the tick with the largest change
  double moved_m = 0.0;          ///< in that tick
  TickStatus recorded = TickStatus::unconverged, resolved = TickStatus::unconverged;  ///< in that tick
  std::uint64_t ticks = 0;                                                            ///< number of changed ticks
};

struct RunNumbers {
  std::uint64_t ticks = 0;
  std::uint64_t unconverged = 0;  ///< or `facing`
  double mean_iterations = 0.0;
  std::int32_t p99_iterations = 0, most_iterations = 0;
  double mean_error_m = 0.0, worst_error_m = 0.0;
};

struct ResolvedHistory {
  std::vector<ResolvedTick> ticks;     ///< in the order of the records
  RunNumbers recorded, resolved;       ///< over the solved ticks
  std::vector<ContactChange> changes;  ///< in order; only the first kMostChanges
  std::uint64_t changed_ticks = 0;     ///< all of them
  std::uint64_t different_ticks = 0;   ///< not identical to the recording
  std::uint64_t taken_over = 0;  ///< contacts taken from the recording, since no value that the solver reads changed
  double ns_per_tick = 0.0;      ///< processor time; 0: not measured, or contacts were taken over
  bool complete = false;

  static constexpr std::size_t kMostChanges = 1000;
};

/// Touching, not touching or without a contact (unconverged, facing) where it was not, or moved by over ten tolerances
/// (of the larger one).
bool contact_changed(const TickOutput& recorded, const TickOutput& resolved, double tolerance_m);
/// Whether two outputs are identical, bit by bit.
bool same_bits(const TickOutput& a, const TickOutput& b);

/// Solves the chunks of a run, in any order and from any number of threads, each chunk once. `run` must outlive it.
class HistoryResolver {
 public:
  static constexpr std::size_t kChunk = 2048, kLeadIn = 32;  ///< ticks

  /// `preset`: used for every tick; none: each tick under its recorded preset. `timed`: measures processor time.
  /// Records before index `first` are not counted.
  HistoryResolver(const RecordedRun& run, std::optional<Preset> preset, bool timed, std::size_t first = 0);
  ~HistoryResolver();

  std::size_t chunk_count() const;
  /// The chunk that contains this record.
  std::size_t chunk_of(std::size_t record) const { return record / kChunk; }
  /// Precondition: chunk < chunk_count(), and not solved yet.
  void solve_chunk(std::size_t chunk);
  /// Result over the chunks that were solved. Call once, after the last solve_chunk has returned.
  ResolvedHistory finish();

 private:
  struct ChunkSummary;

  const RecordedRun& run_;
  std::optional<Preset> preset_;
  bool timed_;
  std::size_t first_;
  std::vector<ResolvedTick> ticks_;
  std::vector<ChunkSummary> summaries_;  ///< one per chunk, written by the thread that solves it
};

}  // namespace tangent
