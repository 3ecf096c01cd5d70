#include "workbench/bench/measure.h"

#include "core/finger/plane_contact.h"
#include "core/lab/measure/closed_work.h"
#include "core/lab/measure/converged_answer.h"
#include "core/lab/measure/distribution.h"
#include "core/shading/render.h"
#include "workbench/bench/allocation_count.h"

#include <algorithm>
#include <cmath>

namespace tangent::bench {
namespace {

constexpr std::size_t kStopStride = 64;  // ticks between checks of the stop

/// Closed loops at places of the run: circles of 1/40 of the object's size (2 mm on 80 mm) in the contact's plane.
WorkReport measure_work(const ScenePtr& scene, const Preset& preset, std::span<const TickInput> poses,
                        std::span<const TickOutput> reference, const Stop& stop) {
  constexpr std::size_t kLoops = 12;
  constexpr int kSteps = 256;
  const Vec3 size = scene->mesh().bounds().size();
  const double radius = std::max({size.x, size.y, size.z}) / 40.0;
  Stepper stepper(scene);
  WorkReport report;
  for (std::size_t i = 0; i < kLoops && !stop(); ++i) {
    const std::size_t tick = i * poses.size() / kLoops;
    const ClosedWork work =
        work_around(stepper, preset, circle_of_poses(poses[tick].finger, reference[tick].normal, radius, kSteps));
    ++report.loops;
    if (work.broken) {
      ++report.broken;
      continue;
    }
    report.mean_j += std::abs(work.work_j);
    report.max_j = std::max(report.max_j, std::abs(work.work_j));
    report.max_relative = std::max(report.max_relative, work.relative());
  }
  if (report.loops > report.broken) report.mean_j /= report.loops - report.broken;
  return report;
}

MethodReport measure_method(Method method, const BenchCase& bench_case, const ScenePtr& scene,
                            std::span<const TickInput> poses, std::span<const TickOutput> reference,
                            std::span<const TickOutput> facet, const MeasureOptions& options, const TickClock& clock) {
  MethodReport report;
  report.method = method;
  Preset preset = bench_case.preset;
  preset.solver.method = method;
  if (method == Method::paper && !bench_case.own_gains) preset = with_best_gain(scene, preset, poses, options.stop);
  report.gain_curvature_m = preset.solver.gain_curvature_m;
  const TimedRun run = timed_run(scene, preset, poses, options.repeats, clock, options.stop);
  report.run = run_statistics(poses, run.outputs, run.ns);
  RoughnessCounter roughness;
  for (std::size_t i = 0; i < run.outputs.size(); ++i) roughness.add(preset, poses[i], run.outputs[i]);
  report.roughness = roughness.result();
  report.typical_ns = run.typical_ns;
  report.allocations = run.allocations;
  report.allocations_counted = allocation_count().counted;
  if (run.stopped) return report;
  if (is_smooth(method))
    report.from_own = difference_from_own(scene, preset, poses, options.stop, report.places_without_solution);
  RunComparison comparison;
  comparison.reserve(poses.size());
  for (std::size_t i = 0; i < run.outputs.size(); ++i) {
    comparison.add(run.outputs[i], reference[i]);
    if (!is_converged(run.outputs[i].status) || !is_round(preset.finger)) continue;
    report.max_depth_gap_m =
        std::max(report.max_depth_gap_m, std::abs(run.outputs[i].penetration_m - facet[i].penetration_m));
  }
  report.from_reference = comparison.result();
  report.work = measure_work(scene, preset, poses, reference, options.stop);
  return report;
}

}  // namespace

TimedRun timed_run(const ScenePtr& scene, const Preset& preset, std::span<const TickInput> poses, int repeats,
                   const TickClock& clock, const Stop& stop) {
  TimedRun run;
  run.outputs.resize(poses.size());
  run.ns.assign(poses.size(), 1e300);
  std::vector<double> readings;
  readings.reserve(poses.size() * static_cast<std::size_t>(std::max(0, repeats)));
  for (int pass = 0; pass < repeats; ++pass) {
    Stepper stepper(scene);
    TickState state;
    const std::uint64_t before = allocation_count().count;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i % kStopStride == 0 && stop()) {
        run.stopped = true;
        run.outputs.resize(pass == 0 ? i : poses.size());
        run.ns.resize(run.outputs.size());
        return run;
      }
      const std::int64_t from = clock.mark();
      const TickOutput output = stepper.step(preset, poses[i], state);
      const std::int64_t to = clock.mark();
      run.outputs[i] = output;
      readings.push_back(clock.elapsed_ns(from, to));
      run.ns[i] = std::min(run.ns[i], readings.back());
    }
    run.allocations += allocation_count().count - before;
  }
  run.typical_ns = middle_mean(std::move(readings));
  return run;
}

Preset with_best_gain(const ScenePtr& scene, Preset preset, std::span<const TickInput> poses, const Stop& stop) {
  constexpr std::size_t kTrialTicks = 2000;
  const double length =
      preset.finger.reach_m() > 0.0 ? preset.finger.reach_m() : 0.25 * glm::length(scene->mesh().bounds().size());
  const std::span<const TickInput> trial = poses.first(std::min(poses.size(), kTrialTicks));
  double best_gain = length;
  std::pair<std::uint64_t, double> best{~0ull, 0.0};
  for (const double share : {1.0, 0.0, 0.25, 0.5, 1.5, 2.0, 4.0}) {
    preset.solver.gain_curvature_m = share * length;
    Stepper stepper(scene);
    TickState state;
    std::pair<std::uint64_t, double> score{0, 0.0};
    for (std::size_t i = 0; i < trial.size(); ++i) {
      if (i % kStopStride == 0 && stop()) return preset;
      const TickOutput output = stepper.step(preset, trial[i], state);
      score.first += !is_converged(output.status);
      score.second += output.iterations;
    }
    if (score < best) best = score, best_gain = preset.solver.gain_curvature_m;
  }
  preset.solver.gain_curvature_m = best_gain;
  return preset;
}

RunDifference difference_from_own(const ScenePtr& scene, const Preset& preset, std::span<const TickInput> poses,
                                  const Stop& stop, std::uint64_t& lost) {
  RunComparison comparison;
  comparison.reserve(poses.size());
  lost = 0;
  add_difference_from_own(scene, preset, poses, stop, comparison, lost);
  return comparison.result();
}

void add_difference_from_own(const ScenePtr& scene, const Preset& preset, std::span<const TickInput> poses,
                             const Stop& stop, RunComparison& comparison, std::uint64_t& lost) {
  const double tolerance = std::min(converged_tolerance_m(*scene, preset.finger), 0.1 * preset.solver.tolerance_m);
  Stepper stepper(scene), exact(scene);
  TickState state;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i % kStopStride == 0 && stop()) break;
    const TickOutput output = stepper.step(preset, poses[i], state);
    if (!is_converged(output.status)) {
      comparison.leave_out();
      continue;
    }
    const std::optional<TickOutput> answer = converged_answer(exact, preset, poses[i], state, tolerance);
    if (answer) {
      comparison.add(output, *answer);
    } else {
      comparison.leave_out();
      ++lost;
    }
  }
}

std::optional<SceneReport> measure_scene(const std::string& suite, const BenchCase& bench_case, const ScenePtr& scene,
                                         const std::vector<TickInput>& poses, const MeasureOptions& options,
                                         const TickClock& clock) {
  SceneReport report;
  report.suite = suite;
  report.name = bench_case.name;
  report.what = bench_case.what;
  report.triangles = scene->mesh().usable_triangle_count();
  report.memory_bytes = scene->memory_bytes();
  report.ticks = poses.size();
  report.converged_tolerance_m = converged_tolerance_m(*scene, bench_case.preset.finger);

  Preset exact = bench_case.preset;
  exact.solver.method = Method::robust;
  exact.solver.tolerance_m = std::min(report.converged_tolerance_m, 0.1 * exact.solver.tolerance_m);
  const TimedRun reference = timed_run(scene, exact, poses, 1, clock, options.stop);
  Preset flat = bench_case.preset;
  flat.solver.method = Method::facet;
  const TimedRun facet = timed_run(scene, flat, poses, 1, clock, options.stop);
  if (reference.stopped || facet.stopped) return std::nullopt;

  report.evaluation = evaluation_time(scene->mesh(), reference.outputs, bench_case.preset.solver.normal_form, clock);
  for (const Method method : kMeasuredMethods) {
    report.methods.push_back(
        measure_method(method, bench_case, scene, poses, reference.outputs, facet.outputs, options, clock));
    if (options.stop()) return std::nullopt;
  }
  for (const Peer& peer : make_peers(*scene, bench_case.preset.finger.reach_m()))
    report.peers.push_back(peer_report(peer, *scene, poses, options.repeats, clock, options.stop));
  if (options.stop()) return std::nullopt;
  return report;
}

Result<std::optional<SceneReport>> measure_case(const std::string& suite, const BenchCase& bench_case,
                                                const MeasureOptions& options, const TickClock& clock) {
  const Result<ScenePtr> scene = build_scene(bench_case);
  if (!scene) return tl::unexpected(scene.error());
  const auto poses = bench_case.poses(**scene, bench_case.preset.finger, options.ticks);
  if (!poses) return tl::unexpected(poses.error());
  return measure_scene(suite, bench_case, *scene, *poses, options, clock);
}

}  // namespace tangent::bench
