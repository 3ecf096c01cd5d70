// Runs scenes and fills their reports.
#pragma once

#include "workbench/bench/scene_report.h"

namespace tangent::bench {

struct MeasureOptions {
  int ticks = 10'000;
  /// Passes over the same poses; a tick's time is the minimum. A tick does the same work in each pass, so the variation
  /// is the machine's noise. 1 where one pass would warm the caches for the next.
  int repeats = 3;
  Stop stop = [] { return false; };
};

/// The methods that are measured, in the order of reports.
inline constexpr std::array kMeasuredMethods{Method::paper, Method::newton,        Method::robust,
                                             Method::facet, Method::force_shading, Method::two_pass};

/// Empty when stopped before the end.
std::optional<SceneReport> measure_scene(const std::string& suite, const BenchCase& bench_case, const ScenePtr& scene,
                                         const std::vector<TickInput>& poses, const MeasureOptions& options,
                                         const TickClock& clock);

/// Builds the case's scene and poses and measures it. Empty when stopped; an error when it can't be built.
Result<std::optional<SceneReport>> measure_case(const std::string& suite, const BenchCase& bench_case,
                                                const MeasureOptions& options, const TickClock& clock);

/// Icospheres of radius 40 mm from 1,280 to at most `most_triangles`: each is written to a temporary PLY, read, built,
/// and explored by a 20 mm finger at 20 mm/s; then the finger jumps to another place every tick. Calls done(report)
/// after each.
Status measure_scale(std::uint32_t most_triangles, const MeasureOptions& options, const TickClock& clock,
                     const std::function<void(SceneReport)>& done);

/// Sweeps the tolerance from 1e-3 to 1e-9 mm on one case.
Result<std::optional<WorkPrecisionReport>> measure_work_precision(const BenchCase& bench_case,
                                                                  const MeasureOptions& options,
                                                                  const TickClock& clock);

/// Outputs of a run and the time of every tick.
struct TimedRun {
  std::vector<TickOutput> outputs;
  std::vector<double> ns;   ///< of each tick, minimum over the passes
  double typical_ns = 0.0;  ///< middle mean of all ticks of all passes
  std::uint64_t allocations = 0;
  bool stopped = false;
};
TimedRun timed_run(const ScenePtr& scene, const Preset& preset, std::span<const TickInput> poses, int repeats,
                   const TickClock& clock, const Stop& stop);

/// `preset` with the G_k between 0 and 4 times the finger's reach that leaves the fewest ticks unconverged and, among
/// those, takes the fewest iterations.
Preset with_best_gain(const ScenePtr& scene, Preset preset, std::span<const TickInput> poses, const Stop& stop);

/// Distance of the run's contacts from the same contacts iterated on to the converged tolerance. `lost`: converged
/// ticks from which that led to another place.
RunDifference difference_from_own(const ScenePtr& scene, const Preset& preset, std::span<const TickInput> poses,
                                  const Stop& stop, std::uint64_t& lost);
/// The same, added to what was compared before.
void add_difference_from_own(const ScenePtr& scene, const Preset& preset, std::span<const TickInput> poses,
                             const Stop& stop, RunComparison& comparison, std::uint64_t& lost);

}  // namespace tangent::bench
