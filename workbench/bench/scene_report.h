// Results of the benchmark for one scene, as plain data.
#pragma once

#include "core/lab/measure/roughness.h"
#include "core/lab/measure/scene_statistics.h"
#include "workbench/bench/bench_case.h"
#include "workbench/bench/evaluation_time.h"
#include "workbench/bench/peers.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tangent::bench {

/// Work of the force along small closed paths (core/lab/measure/closed_work.h).
struct WorkReport {
  int loops = 0, broken = 0;         ///< broken: with an unconverged tick; excluded from the figures
  double mean_j = 0.0, max_j = 0.0;  ///< of |work|
  double max_relative = 0.0;         ///< |work| over the peak stored energy of its loop
};

struct MethodReport {
  Method method = Method::robust;
  double gain_curvature_m = 0.0;  ///< `paper`: the best found for the scene
  RunStatistics run;
  Roughness roughness;      ///< of force and display, before and after fading
  double typical_ns = 0.0;  ///< middle mean of all ticks of all passes: what ratios use
  std::optional<RunDifference>
      from_own;  ///< from the same contact iterated to the converged tolerance; none for facet methods
  std::uint64_t places_without_solution = 0;  ///< converged ticks from which that led to another place
  RunDifference from_reference;               ///< from `robust` at the converged tolerance
  /// Largest |penetration - penetration into the raw mesh| over the converged ticks. Larger than the patches' bulge
  /// where a deeper place was missed, or where raw mesh and normals disagree about the outside. 0 for fingers that are
  /// not round.
  double max_depth_gap_m = 0.0;
  std::uint64_t allocations = 0;
  bool allocations_counted = false;
  WorkReport work;
};

struct LoadReport {
  double generate_s = 0.0, read_s = 0.0, mesh_s = 0.0, structures_s = 0.0;  ///< read_s: 0 where no file was read
  double ready_s() const { return read_s + mesh_s + structures_s; }
};

struct SceneReport {
  std::string suite, name, what;
  std::uint32_t triangles = 0;
  std::size_t memory_bytes = 0;
  std::size_t ticks = 0;
  LoadReport load;
  EvaluationTime evaluation;
  double converged_tolerance_m = 0.0;
  std::vector<MethodReport> methods;
  std::vector<PeerReport> peers;
  std::optional<RunStatistics> reseeding;  ///< scale suite: another place every tick

  const MethodReport* of(Method method) const {
    for (const MethodReport& m : methods)
      if (m.method == method) return &m;
    return nullptr;
  }
};

/// One point of a work-precision curve.
struct WorkPrecisionPoint {
  double tolerance_m = 0.0;
  double mean_ns = 0.0, p50_ns = 0.0;
  double error_p50_m = 0.0, error_p99_m = 0.0;  ///< of the contact, from the converged answer
  double unconverged_share = 0.0;
};
struct WorkPrecisionCurve {
  Method method = Method::robust;
  std::vector<WorkPrecisionPoint> points;  ///< one for methods without a tolerance
};
struct WorkPrecisionReport {
  std::string scene;
  std::uint32_t triangles = 0;
  std::vector<WorkPrecisionCurve> curves;
};

struct BenchReport {
  double clock_overhead_ns = 0.0;
  int repeats = 1;
  bool interrupted = false;
  std::vector<SceneReport> scenes;
  std::vector<WorkPrecisionReport> work_precision;
};

}  // namespace tangent::bench
