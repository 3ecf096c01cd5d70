#include "workbench/sweep/front_verdict.h"

#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"
#include "workbench/session/exploration_poses.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace tangent::sweep {

using test::approx;
namespace {

FrontGround held_back_ground(std::size_t ticks) {
  const auto scene = *ContactScene::build(*ContactMesh::build(*generate_mesh("torus"), {}));
  auto poses = exploration_poses(*scene, Finger{}, ExplorationKind::around, ExplorationPace::varied);
  REQUIRE(poses);
  poses->poses.resize(ticks);
  return {{scene, std::make_shared<const std::vector<TickInput>>(std::move(poses->poses))}, ticks * 3 / 4};
}

FrontPlan plan_of(const char* objective) {
  FrontPlan plan;
  plan.base.solver.method = Method::paper;
  Range range;
  range.key = find_preset_key("solver.gain_curvature_m");
  range.to = 0.08;
  plan.ranges = {range};
  plan.objectives = {*find_objective(objective)};
  return plan;
}

Trial tried(const FrontPlan& plan, const std::vector<FrontGround>& grounds, double gain) {
  Preset preset = plan.base;
  preset.solver.gain_curvature_m = gain;
  Trial out = try_preset(plan, grounds, preset, false);
  out.values = {gain};
  return out;
}

Preset with_gain(const FrontPlan& plan, double gain) {
  Preset out = plan.base;
  out.solver.gain_curvature_m = gain;
  return out;
}

TEST_CASE("a preset wins on ticks held back, and not against itself") {
  const std::vector<FrontGround> grounds{held_back_ground(800)};
  const FrontPlan plan = plan_of("mean_iterations");
  const std::vector<Trial> trials{tried(plan, grounds, 0.002), tried(plan, grounds, 0.02)};
  const Verdict better = judge_front(plan, grounds, trials, with_gain(plan, 0.002));
  CHECK(better.chosen == 1);
  CHECK(better.clearly);
  CHECK(better.held_back);
  CHECK(better.times.empty());
  CHECK(better.mine.ticks == 200);
  CHECK(!judge_front(plan, grounds, trials, with_gain(plan, 0.02)).clearly);
}

TEST_CASE("of a front the points that beat the simple preset in everything come first") {
  const std::vector<FrontGround> grounds{held_back_ground(800)};
  FrontPlan plan = plan_of("mean_iterations");
  plan.objectives.push_back(*find_objective("error_p99_m"));
  plan.ranges[0].key = find_preset_key("solver.tolerance_m");
  plan.base.solver.gain_curvature_m = 0.02;
  std::vector<Trial> trials;
  for (const double tolerance : {1e-4, 1e-5, 1e-7}) {
    Preset preset = plan.base;
    preset.solver.tolerance_m = tolerance;
    trials.push_back(try_preset(plan, grounds, preset, false));
    trials.back().values = {tolerance};
  }
  Preset simple = plan.base;  // worse gains: the last point beats it, the others trade error for planes
  simple.solver.tolerance_m = 1e-6;
  simple.solver.gain_curvature_m = 0.004;
  const Verdict verdict = judge_front(plan, grounds, trials, simple);
  CHECK(front_of(trials).size() == 3);
  CHECK(balanced(trials, front_of(trials)) != 2);
  CHECK(verdict.chosen == 2);
  CHECK(verdict.clearly);
}

TEST_CASE("a point that misses a constraint on the ticks held back is passed over") {
  const std::vector<FrontGround> grounds{held_back_ground(800)};
  FrontPlan plan = plan_of("mean_iterations");
  plan.objectives.push_back(*find_objective("error_p99_m"));
  const std::vector<Trial> trials{tried(plan, grounds, 0.02), tried(plan, grounds, 0.03), tried(plan, grounds, 0.05)};
  const std::size_t points = front_of(trials).size();
  const Verdict first = judge_front(plan, grounds, trials, plan.base);
  // Which the chosen one misses by a hair, on those ticks alone.
  plan.constraints = {Constraint{plan.objectives[0], first.mine.objectives[0] * (1.0 - 1e-9)}};
  const Verdict second = judge_front(plan, grounds, trials, plan.base);
  if (points > 1 && second.mine.missed == 0.0) {
    CHECK(second.chosen != first.chosen);
    CHECK(second.passed_over > 0);
  } else {
    CHECK(second.mine.missed > 0.0);
  }
  plan.constraints[0].most = 1e-3;  // none can
  const Verdict none = judge_front(plan, grounds, trials, plan.base);
  CHECK(none.mine.missed > 0.0);
  CHECK(none.chosen == first.chosen);
}

TEST_CASE("where time is asked for it is measured, and a scale says how it is to what is counted") {
  std::vector<FrontGround> grounds{held_back_ground(800)};
  FrontPlan plan = plan_of("mean_time");
  CHECK(measure_scales(plan, plan.base, grounds));
  CHECK(grounds[0].scale.mean > 0.0);
  CHECK(grounds[0].scale.p99 > 0.0);
  const std::vector<Trial> trials{tried(plan, grounds, 0.0), tried(plan, grounds, 0.02)};
  const Verdict verdict = judge_front(plan, grounds, trials, with_gain(plan, 0.0));
  REQUIRE(verdict.times.size() == 1);
  CHECK(verdict.chosen == 1);
  const PairedTime& time = verdict.times[0].mean;
  if (time.verdict == TimeVerdict::tie) {  // a machine that is busy otherwise
    CHECK(verdict.mine.objectives == verdict.simple.objectives);
    CHECK(!verdict.clearly);
  } else {
    CHECK(verdict.mine.objectives[0] == approx(time.ns * 1e-3));
    CHECK(verdict.simple.objectives[0] == approx(time.against_ns * 1e-3));
    CHECK(verdict.clearly == (time.ns < 0.98 * time.against_ns));
  }
  plan.constraints = {*parse_constraint("p99_time <= 1 ns")};
  CHECK(judge_front(plan, grounds, trials, plan.base).mine.missed > 0.0);
  plan.stop = [] { return true; };
  CHECK(!measure_scales(plan, plan.base, grounds));
}

TEST_CASE("counted time follows what ticks take: it says which of two presets that differ is the faster") {
  const FrontGround on = held_back_ground(800);
  const FrontPlan plan = plan_of("mean_time");
  double last = 1e300;
  for (const double gain : {0.0, 0.002, 0.02}) {
    const double counted = tried(plan, {on}, gain).objectives[0];
    CHECK(counted < last);
    last = counted;
  }
}

}  // namespace
}  // namespace tangent::sweep
