#include "workbench/session/sweep.h"

#include "session_fixture.h"

#include <algorithm>
#include <map>

using namespace tangent;

namespace {

RecordedRun paper_run() {
  static const std::unique_ptr<Session> session = [] {
    SessionOptions options;
    options.threaded = false;
    Preset preset;
    preset.solver.method = Method::paper;
    auto made = Session::create(test::torus_scene(), preset, options);
    REQUIRE(made);
    (*made)->start();
    (*made)->advance(3000);
    return std::move(*made);
  }();
  return session->recorded_run();
}

SweepPlan plan_over(std::vector<SweepAxis> axes) {
  SweepPlan plan;
  plan.base.solver.method = Method::paper;
  plan.axes = std::move(axes);
  return plan;
}

const PresetKey& key(std::string_view name) { return *find_preset_key("solver", name); }

}  // namespace

TEST_CASE("values of a sweep: both ends, equal steps or factors, whole where the key is, never out of range") {
  const SweepAxis gain = sweep_axis(key("gain_overall"), 0.5, 1.5, 5);
  CHECK(gain.values == std::vector<double>{0.5, 0.75, 1.0, 1.25, 1.5});
  const PresetKey& tolerance = key("tolerance_m");
  REQUIRE(tolerance.logarithmic);
  const SweepAxis factors = sweep_axis(tolerance, 1e-7, 1e-5, 3);
  CHECK(factors.values[1] == doctest::Approx(1e-6));
  const SweepAxis whole = sweep_axis(key("max_iterations"), 1.0, 4.0, 10);
  CHECK(whole.values == std::vector<double>{1.0, 2.0, 3.0, 4.0});
  for (const double v : sweep_axis(key("gain_overall"), -5.0, 1e9, 7).values) CHECK(key("gain_overall").allows(v));
  CHECK(sweep_axis(key("gain_overall"), 1.0, 2.0, 1).values == std::vector<double>{1.0});
}

TEST_CASE("each point of a sweep is the run over the past under its preset") {
  const RecordedRun run = paper_run();
  const SweepPlan plan =
      plan_over({sweep_axis(key("gain_curvature_m"), 0.0, 0.030, 4), sweep_axis(key("gain_overall"), 0.8, 1.2, 3)});
  REQUIRE(plan.point_count() == 12);
  const RunPart part = part_of(run, 500, 2500);
  CHECK(part.run.records[part.first].tick.tick == 500);
  for (const std::size_t i : {0u, 5u, 11u}) {
    const SweepPoint point = solve_sweep_point(part, plan, i);
    const PresetsCompared both = [&] {
      PresetComparison comparison(part.run, part.first, plan.base, plan.preset(point.values), false);
      for (std::size_t chunk = 0; chunk < comparison.chunk_count(); ++chunk) comparison.solve_chunk(chunk);
      return comparison.finish();
    }();
    CHECK(point.numbers.ticks == 2000);
    CHECK(point.numbers.mean_iterations == both.after_numbers.mean_iterations);
    CHECK(point.numbers.p99_iterations == both.after_numbers.p99_iterations);
    CHECK(point.numbers.unconverged == both.after_numbers.unconverged);
  }
  CHECK(plan.values(5) == std::vector<double>{plan.axes[0].values[1], plan.axes[1].values[1]});
}

TEST_CASE("a sweep in threads finds the same points as in the caller's thread, each once") {
  const SweepPlan plan = plan_over({sweep_axis(key("gain_curvature_m"), 0.0, 0.030, 9)});
  const auto solve = [&](unsigned threads) {
    SweepJob job;
    job.start(part_of(paper_run(), 0, 1500), plan, threads);
    std::map<double, double> means;
    std::size_t taken = 0;
    while (true) {
      const bool running = job.running();
      for (const SweepPoint& point : job.take()) {
        means[point.values[0]] = point.numbers.mean_iterations;
        ++taken;
      }
      if (!running) break;
      std::this_thread::yield();
    }
    CHECK(taken == 9);
    return means;
  };
  CHECK(solve(0) == solve(3));
}

TEST_CASE("a cancelled sweep stops, and another can be started") {
  SweepJob job;
  const SweepPlan plan = plan_over({sweep_axis(key("gain_curvature_m"), 0.0, 0.030, 60)});
  job.start(part_of(paper_run(), 0, 3000), plan, 2);
  job.cancel();
  CHECK_FALSE(job.running());
  job.start(part_of(paper_run(), 0, 100), plan_over({sweep_axis(key("gain_overall"), 0.8, 1.2, 3)}), 0);
  CHECK(job.take().size() == 3);
}
