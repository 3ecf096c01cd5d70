// Recorded ticks solved again under another preset: what it would have made of the same motion.
//
// The hand moved under the old values, so this compares solvers and not feel; whoever shows it says "same motion
// assumed". Ticks are cut into chunks that know nothing of each other: a chunk starts some ticks early from the state
// that was recorded there and then keeps its own, as the servo does; it takes the recorded one again wherever ticks are
// missing or the scene changed. Under the recorded presets every tick gives the recorded bits.
//
// A preset that differs from the recorded one in nothing that the solver reads has the recorded contacts: they are
// taken over, and only force and display are computed again. Without a preset everything is solved, so that this
// verifies.
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
  float moved_m = 0.0f;  ///< contact to recorded contact
  std::int32_t iterations = 0;
  TickStatus status = TickStatus::unconverged;
  bool contact_changed = false;  ///< see contact_changed()
  bool same_bits = false;        ///< as the recorded output
  bool solved = false;           ///< false: its scene is gone, or its chunk was left out
};

/// A run of ticks whose contact changed, gaps of a few ticks included.
struct ContactChange {
  std::uint64_t first_tick = 0, last_tick = 0;
  std::uint64_t worst_tick = 0;                                                       ///< where it moved most
  double moved_m = 0.0;                                                               ///< there
  TickStatus recorded = TickStatus::unconverged, resolved = TickStatus::unconverged;  ///< there
  std::uint64_t ticks = 0;                                                            ///< changed ones among them
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
  RunNumbers recorded, resolved;       ///< over the ticks that were solved
  std::vector<ContactChange> changes;  ///< in order, the first kMostChanges
  std::uint64_t changed_ticks = 0;     ///< all
  std::uint64_t different_ticks = 0;   ///< not the same bits
  std::uint64_t taken_over = 0;  ///< contacts that are the recorded ones, since the solver reads nothing that changed
  double ns_per_tick = 0.0;      ///< processor time; 0: not measured, as where contacts were taken over
  bool complete = false;

  static constexpr std::size_t kMostChanges = 1000;
};

/// Touching, not touching or without a contact (unconverged, facing) where it was not, or moved by over ten tolerances
/// (of the larger one).
bool contact_changed(const TickOutput& recorded, const TickOutput& resolved, double tolerance_m);
bool same_bits(const TickOutput& a, const TickOutput& b);

/// Chunks of a run, to be solved in any order by any number of threads, each chunk by one.
class HistoryResolver {
 public:
  static constexpr std::size_t kChunk = 2048, kLeadIn = 32;  ///< ticks

  /// `preset`: for every tick; none: each is solved under the one it was recorded with. `timed`: measures processor
  /// time.
  HistoryResolver(const RecordedRun& run, std::optional<Preset> preset, bool timed);
  ~HistoryResolver();

  std::size_t chunk_count() const;
  /// The chunk that holds that record.
  std::size_t chunk_of(std::size_t record) const { return record / kChunk; }
  /// Precondition: chunk < chunk_count(), and not solved yet.
  void solve_chunk(std::size_t chunk);
  /// Sums it all up, chunks not solved left out. Once, after the last solve_chunk has returned.
  ResolvedHistory finish();

 private:
  struct ChunkSummary;
  class Replay;

  const RecordedRun& run_;
  std::optional<Preset> preset_;
  bool timed_;
  std::vector<ResolvedTick> ticks_;
  std::vector<ChunkSummary> summaries_;  ///< one a chunk, written by the thread that solves it
};

}  // namespace tangent
