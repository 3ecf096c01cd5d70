#include "workbench/sweep/sweep_estimate.h"

#include "workbench/sweep/cell_numbers.h"
#include "workbench/sweep/inputs.h"

#include <algorithm>
#include <chrono>

namespace tangent::sweep {
namespace {

constexpr std::size_t kTriedTicks = 2000;

}  // namespace

Result<SweepEstimate> estimate(const Cells& cells) {
  Inputs inputs(cells.plan());
  const Cell cell = cells.at(0);
  const Result<Ground> ground = inputs.ground(cell.mesh, cell.poses, cell.finger);
  if (!ground) return tl::unexpected(ground.error());
  Stepper stepper(ground->scene), exact(ground->scene);
  SweepEstimate out;
  out.tried_ticks = std::min(kTriedTicks, ground->motion->size());
  const auto began = std::chrono::steady_clock::now();
  static_cast<void>(
      measure_cell(stepper, exact, cells.preset(cell), std::span(*ground->motion).first(out.tried_ticks)));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  out.ns_a_tick = seconds * 1e9 / static_cast<double>(out.tried_ticks);
  out.ticks = static_cast<double>(cells.size()) * static_cast<double>(ground->motion->size());
  out.seconds = out.ticks * out.ns_a_tick * 1e-9;
  out.memory_bytes = static_cast<double>(ground->scene->memory_bytes() + ground->motion->size() * sizeof(TickInput));
  out.result_bytes = static_cast<double>(cells.size()) * 9.0 * static_cast<double>(number_columns().size() + 8);
  return out;
}

JobScripts bundled(double seconds, std::uint64_t shards, double job_seconds) {
  JobScripts out;
  const double a_shard = std::max(1e-9, seconds / static_cast<double>(shards));
  out.shards_a_job = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(job_seconds / a_shard), 1, shards);
  out.seconds_a_job = a_shard * static_cast<double>(out.shards_a_job);
  return out;
}

}  // namespace tangent::sweep
