// workbench bench --mesh: speed against error on a mesh and motion of one's own.
#pragma once

#include "workbench/bench/speed_curves.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/preset_options.h"

namespace tangent {

struct BenchCurvesOptions {
  MeshOptions mesh;  ///< file empty: not asked for
  PresetOptions preset;
  std::vector<std::string> methods;  ///< as given
  std::filesystem::path poses;       ///< empty: the simulated hand explores
  int ticks = 0;                     ///< 0: all poses, or 10,000 of the hand's
  std::filesystem::path csv, json, plot;
  bench::SpeedCurvesOptions curves;
  std::string command;  ///< as it was typed
};

/// Prints the table and writes the files. `interrupted`: what was measured until then is kept. Precondition: an
/// InterruptGuard.
Status run_bench_curves(BenchCurvesOptions options, bool& interrupted);

}  // namespace tangent
