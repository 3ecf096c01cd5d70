// A sweep from beginning to end: in one process into a results file, or shard by shard, merged later. Every one goes on
// from what is there, and keeps what it has when it is stopped.
#pragma once

#include "workbench/sweep/plan_folder.h"
#include "workbench/sweep/results_file.h"

namespace tangent::sweep {

struct SweepProgress {
  std::uint64_t done = 0, planned = 0;  ///< cells; `done` counts those that were there before
};

struct SweepOptions {
  unsigned threads = 1;
  std::function<bool()> stop = [] { return false; };                  ///< asked by any thread
  std::function<void(const SweepProgress&)> progress = [](auto&) {};  ///< called by one thread at a time
  std::function<void(const std::string&)> note = {};                  ///< likewise; on a motion that touches nothing
};

struct SweepOutcome {
  std::uint64_t cells = 0, before = 0, solved = 0;  ///< before: found done; solved: or found to fail
  std::uint64_t ticks = 0;                          ///< of the cells solved now
  double seconds = 0.0;
  std::uint64_t failed = 0;  ///< of `solved`: those that have no numbers
  Failures failures;         ///< in the file: of this run and of those before
  bool stopped = false;
};

/// Times that a merge did not find, though they were asked for or other cells have them.
struct LackingTimes {
  std::uint64_t cells = 0, shards = 0;
  std::uint64_t first_shard = 0, first_cells = 0;  ///< the lowest such shard, and how many cells it lacks
};

struct MergeOutcome : SweepOutcome {
  LackingTimes lacking;
};

/// Solves the cells that `file` lacks.
Result<SweepOutcome> run_sweep(const Cells& cells, ResultsFile& file, const SweepOptions& options);

/// Times each cell that has no time against the first of its group (mesh, motion, finger), on this thread alone, over
/// the motion's first `ticks`. Call it when nothing else runs. Returns how many were timed.
Result<std::uint64_t> time_sweep(const Cells& cells, ResultsFile& file, std::size_t rounds, std::size_t ticks,
                                 const SweepOptions& options);

/// Times the shard's cells that have numbers and no time yet, each against the first of its group, on this thread
/// alone. Returns how many were timed.
Result<std::uint64_t> time_shard(const PlanFolder& folder, std::uint64_t shard, std::size_t rounds,
                                 const SweepOptions& options);

/// Fails where the folder has no such shard.
Status check_shard(const PlanFolder& folder, std::uint64_t shard);

/// Solves the cells that the shard's file lacks.
Result<SweepOutcome> run_shard(const PlanFolder& folder, std::uint64_t shard, const SweepOptions& options);

/// All shards into one results file, as one process would have written it. Memory does not grow with the shards. A
/// shard that is missing, torn, foreign or not finished is refused by name, and a file that was not there before is not
/// there after.
Result<MergeOutcome> merge_shards(const PlanFolder& folder, const std::filesystem::path& out,
                                  const SweepOptions& options);

}  // namespace tangent::sweep
