#include "core/lab/measure/converged_answer.h"
#include "core/shading/render.h"
#include "workbench/bench/measure.h"
#include "workbench/bench/speed_curves.h"

namespace tangent::bench {
namespace {

constexpr std::array kTolerances{1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};  // m: 1e-3 to 1e-9 mm

WorkPrecisionPoint measure_point(const ScenePtr& scene, const Preset& preset, const std::vector<TickInput>& poses,
                                 const MeasureOptions& options, const TickClock& clock) {
  WorkPrecisionPoint point;
  point.tolerance_m = preset.solver.tolerance_m;
  const TimedRun run = timed_run(scene, preset, poses, options.repeats, clock, options.stop);
  const RunStatistics s = run_statistics(std::span(poses).first(run.outputs.size()), run.outputs, run.ns);
  point.mean_ns = s.ns.mean;
  point.p50_ns = s.ns.p50;
  point.unconverged_share = s.ticks > 0 ? static_cast<double>(s.unconverged()) / static_cast<double>(s.ticks) : 0.0;
  std::uint64_t lost = 0;
  const RunDifference own = difference_from_own(scene, preset, poses, options.stop, lost);
  point.error_p50_m = own.contact_m.p50;
  point.error_p99_m = own.contact_m.p99;
  return point;
}

/// Facet methods have no tolerance: their error is their distance from the smooth surface's contact.
WorkPrecisionPoint measure_flat(const ScenePtr& scene, const Preset& preset, const std::vector<TickInput>& poses,
                                const MeasureOptions& options, const TickClock& clock) {
  Preset exact = preset;
  exact.solver.method = Method::robust;
  exact.solver.tolerance_m = converged_tolerance_m(*scene, preset.finger);
  const TimedRun reference = timed_run(scene, exact, poses, 1, clock, options.stop);
  const TimedRun run = timed_run(scene, preset, poses, options.repeats, clock, options.stop);
  RunComparison comparison;
  for (std::size_t i = 0; i < std::min(run.outputs.size(), reference.outputs.size()); ++i)
    comparison.add(run.outputs[i], reference.outputs[i]);
  const RunDifference d = comparison.result();
  const Distribution ns = distribution(run.ns);
  return {0.0, ns.mean, ns.p50, d.contact_m.p50, d.contact_m.p99, 0.0};
}

}  // namespace

Result<std::optional<WorkPrecisionReport>> measure_work_precision(const BenchCase& bench_case,
                                                                  const MeasureOptions& options,
                                                                  const TickClock& clock) {
  const Result<ScenePtr> scene = build_scene(bench_case);
  if (!scene) return tl::unexpected(scene.error());
  const auto poses = bench_case.poses(**scene, bench_case.preset.finger, options.ticks);
  if (!poses) return tl::unexpected(poses.error());
  WorkPrecisionReport report;
  report.scene = bench_case.name;
  report.triangles = (*scene)->mesh().usable_triangle_count();
  for (const Method method : kMeasuredMethods) {
    WorkPrecisionCurve curve;
    curve.method = method;
    Preset preset = bench_case.preset;
    preset.solver.method = method;
    preset.solver.max_iterations = kLastIterations;
    if (!is_smooth(method)) {
      curve.points.push_back(measure_flat(*scene, preset, *poses, options, clock));
    } else {
      if (method == Method::paper) preset = with_best_gain(*scene, preset, *poses, options.stop);
      for (const double tolerance : kTolerances) {
        preset.solver.tolerance_m = tolerance;
        curve.points.push_back(measure_point(*scene, preset, *poses, options, clock));
        if (options.stop()) return std::optional<WorkPrecisionReport>();
      }
    }
    report.curves.push_back(std::move(curve));
  }
  if (options.stop()) return std::optional<WorkPrecisionReport>();
  return std::optional(std::move(report));
}

}  // namespace tangent::bench
