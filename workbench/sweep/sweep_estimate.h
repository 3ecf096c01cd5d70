// How long a sweep will take and how large it will be, by trying the first cell.
#pragma once

#include "workbench/sweep/plan_folder.h"

namespace tangent::sweep {

struct SweepEstimate {
  double ticks = 0.0, seconds = 0.0;  ///< of all cells, one after the other
  double ns_a_tick = 0.0;             ///< with all that is measured at a tick
  std::size_t tried_ticks = 0;
  double memory_bytes = 0.0;  ///< of the first mesh and motion
  double result_bytes = 0.0;
};

/// Solves up to 2,000 ticks of the first cell; motions of other meshes are taken to be as long. Fails where its mesh or
/// motion can't be had.
Result<SweepEstimate> estimate(const Cells& cells);

/// Shards put together into jobs of about `job_seconds`, of a sweep that takes `seconds` in all.
JobScripts bundled(double seconds, std::uint64_t shards, double job_seconds);

}  // namespace tangent::sweep
