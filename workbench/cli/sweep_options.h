// A sweep's plan from the command line: from a file, or put together from options.
#pragma once

#include "workbench/cli/mesh_options.h"
#include "workbench/cli/preset_options.h"
#include "workbench/sweep/plan.h"

#include <string>
#include <vector>

namespace tangent {

struct SweepPlanOptions {
  std::filesystem::path plan;  ///< a file; then nothing else may be given
  std::vector<std::string> meshes, poses;
  MeshOptions reading;
  PresetOptions preset;
  std::vector<std::string> methods;  ///< as given: names, with commas between
  std::vector<sweep::Range> ranges;
  sweep::Sampling sampling = sweep::Sampling::grid;
  std::size_t samples = 0, ticks = 0;
  std::uint64_t seed = 1;
};

/// MESH..., --poses, --plan, --range, --methods, --sampling, --samples, --seed, --ticks and the options of mesh and
/// preset. `options` must outlive the parser.
void add_sweep_plan_options(CLI::App& app, SweepPlanOptions& options);

/// TABLE.KEY=A,B,C or TABLE.KEY=FROM..TO[:COUNT[:log|linear]]. Ends the parsing on anything else.
sweep::Range parse_range_option(const std::string& text);

/// Fails on a plan or preset that can't be read; ends the parsing on options that contradict each other.
Result<sweep::Plan> sweep_plan(const SweepPlanOptions& options);

}  // namespace tangent
