// A plan divided into shards, for many machines that share a folder:
//   DIR/plan.toml     the plan with every value stated, its meshes and poses named in DIR/inputs
//   DIR/plan.json     its digest, number of cells and of shards, rounds of timing
//   DIR/inputs/       copies of meshes and poses: what is swept can't change while shards are solved
//   DIR/shards/       one file a shard (shard_file.h)
//   DIR/slurm.sh, DIR/parallel.sh   scripts that run all shards, as a job array of Slurm or by GNU parallel
#pragma once

#include "workbench/sweep/cells.h"
#include "workbench/sweep/shard_file.h"

namespace tangent::sweep {

struct PlanFolder {
  std::filesystem::path folder;
  Plan plan;
  std::string digest;
  std::uint64_t cells = 0, shards = 1;
  std::uint64_t times = 0;  ///< rounds of timing that its scripts ask for; 0: none

  std::filesystem::path shard_file(std::uint64_t shard) const;
  ShardName shard(std::uint64_t shard) const { return shard_of(digest, cells, shard, shards); }
};

struct JobScripts {
  std::string program = "workbench";  ///< as the jobs call it
  std::uint64_t shards_a_job = 1;     ///< so that a job takes 10 to 60 minutes
  double seconds_a_job = 0.0;         ///< expected
  std::size_t times = 0;              ///< rounds of timing after a shard's cells; 0: none
};

/// As many shards as cells at most, and one at least.
Status check_shards(std::uint64_t shards, const Cells& cells);

/// Writes the folder. Fails where there is something else in it, and on missing meshes and poses; nothing of it stays
/// then.
Status write_plan_folder(const std::filesystem::path& folder, const Plan& plan, std::uint64_t shards,
                         const JobScripts& scripts);

/// Where the folder holds this very plan, in as many shards: copies its meshes and poses into it again, those that are
/// missing or not as they were. Nothing else changes, shards stay. Returns how many were put back. Fails on a folder
/// of another plan, also where meshes or poses are no longer those that were divided.
Result<std::size_t> put_back_inputs(const std::filesystem::path& folder, const Plan& plan, std::uint64_t shards);

/// Fails where the folder holds no plan, or its plan or inputs are not those that were divided.
Result<PlanFolder> open_plan_folder(const std::filesystem::path& folder);

}  // namespace tangent::sweep
