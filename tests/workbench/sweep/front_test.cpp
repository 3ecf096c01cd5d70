#include "workbench/sweep/front.h"

#include "core/io/scene_file.h"
#include "core/lab/objects/generate.h"
#include "tests/support/meshes.h"
#include "workbench/session/exploration_poses.h"
#include "workbench/sweep/front_search.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace tangent::sweep {
namespace {

Trial point(double x, double y, double missed = 0.0) {
  Trial trial;
  trial.objectives = {x, y};
  trial.missed = missed;
  return trial;
}

TEST_CASE("a front holds what nothing beats, each point once") {
  const std::vector<Trial> trials{point(3, 1), point(1, 3), point(2, 2), point(2, 3), point(2, 2), point(0, 0, 0.5)};
  CHECK(front_of(trials) == std::vector<std::size_t>{1, 2, 0});
  CHECK(trials[balanced(trials, front_of(trials))].objectives == std::vector<double>{2, 2});
  CHECK(front_of(std::vector<Trial>{point(1, 1, 2.0), point(5, 5, 1.0)}) == std::vector<std::size_t>{1});
}

TEST_CASE("the hypervolume is the area up to the reference") {
  CHECK(hypervolume(std::vector<Trial>{point(0, 0)}, {2.0, 4.0}) == 1.0);
  CHECK(hypervolume(std::vector<Trial>{point(1, 2)}, {2.0, 4.0}) == doctest::Approx(0.25));
  CHECK(hypervolume(std::vector<Trial>{point(0.5, 3), point(1, 1), point(1.5, 0.5)}, {2.0, 4.0}) ==
        doctest::Approx((1.5 * 1.0 + 1.0 * 2.0 + 0.5 * 0.5) / 8.0));
  CHECK(hypervolume(std::vector<Trial>{point(3, 1), point(1, 1, 0.1)}, {2.0, 4.0}) == 0.0);
}

TEST_CASE("clearly better is better somewhere and worse nowhere, by more than a share") {
  CHECK(clearly_better(point(1, 1), point(1.1, 1), 0.02));
  CHECK(!clearly_better(point(1, 1), point(1.01, 1), 0.02));
  CHECK(!clearly_better(point(1, 1.1), point(2, 1), 0.02));
  CHECK(clearly_better(point(1, 1.01), point(2, 1), 0.02));
  CHECK(clearly_better(point(9, 9), point(1, 1, 1.0), 0.02));
}

TEST_CASE("objectives and constraints are told by name") {
  CHECK(find_objective("mean_iterations"));
  CHECK(find_objective("speed").error().message().find("mean_iterations") != std::string::npos);
  const auto none = parse_constraint("unconverged = 0"), few = parse_constraint("p99_iterations<=5");
  REQUIRE(none);
  REQUIRE(few);
  CellNumbers numbers;
  numbers.p99_iterations = 5.0;
  CHECK(none->holds(numbers));
  CHECK(few->holds(numbers));
  numbers.unconverged = 3;
  numbers.p99_iterations = 10.0;
  CHECK(none->missed(numbers) == 3.0);
  CHECK(few->missed(numbers) == 1.0);
  CHECK(none->text() == "unconverged = 0");
  CHECK(few->text() == "p99_iterations <= 5");
  for (const char* wrong : {"", "unconverged", "unconverged < 1", "unconverged = 1", "unconverged <= x", "a <= 1",
                            "unconverged <= -1", "<= 1"})
    CHECK_MESSAGE(!parse_constraint(wrong), wrong);
  CHECK(!check_constraints({*few, *few}));
  CHECK(check_constraints({*few, *none}));
}

Range gain(const char* key, double from, double to) {
  Range range;
  range.key = find_preset_key(key);
  range.from = from;
  range.to = to;
  return range;
}

FrontPlan gains_plan(std::size_t evaluations) {
  FrontPlan plan;
  plan.base.solver.method = Method::paper;
  plan.ranges = {gain("solver.gain_overall", 0.5, 1.5), gain("solver.gain_curvature_m", 0.0, 0.08),
                 gain("solver.gain_distance_per_m", 0.0, 800.0), gain("solver.tolerance_m", 1e-8, 1e-4)};
  plan.ranges.back().logarithmic = true;
  plan.objectives = {*find_objective("mean_iterations"), *find_objective("error_p99_m")};
  plan.evaluations = evaluations;
  plan.threads = 2;
  return plan;
}

FrontGround ground(std::shared_ptr<const ContactScene> scene, std::size_t ticks) {
  auto poses = exploration_poses(*scene, Finger{}, ExplorationKind::around, ExplorationPace::varied);
  REQUIRE(poses);
  std::vector<TickInput> some;
  const std::size_t stride = std::max<std::size_t>(1, poses->poses.size() / (2 * ticks));
  for (std::size_t i = 0; i < poses->poses.size(); i += stride) some.push_back(poses->poses[i]);
  return {{std::move(scene), std::make_shared<const std::vector<TickInput>>(std::move(some))}, ticks};
}

TEST_CASE("a search is the same with any number of threads, starts with what it is given, and stops when asked") {
  const auto scene = *ContactScene::build(*ContactMesh::build(*generate_mesh("torus"), {}));
  const std::vector<FrontGround> grounds{ground(scene, 100)};
  FrontPlan plan = gains_plan(60);
  plan.starts = {plan.base};
  const FrontResult two = search_front(plan, grounds);
  CHECK(two.trials.size() == 60);
  CHECK(two.trials[0].values[0] == plan.base.solver.gain_overall);
  plan.threads = 1;
  const FrontResult one = search_front(plan, grounds);
  REQUIRE(one.trials.size() == two.trials.size());
  for (std::size_t i = 0; i < one.trials.size(); ++i) {
    CHECK(one.trials[i].values == two.trials[i].values);
    CHECK(one.trials[i].objectives == two.trials[i].objectives);
  }
  const FrontResult stopped = search_front(plan, grounds, [](std::size_t done) { return done < 20; });
  CHECK(stopped.stopped);
  CHECK(stopped.trials.size() < 60);
  CHECK(stopped.trials.size() >= 20);
}

/// The share of the hypervolume of `random` random presets that a search with `evaluations` reaches.
double share_of_random(const std::vector<FrontGround>& grounds, std::size_t evaluations, std::size_t random) {
  FrontPlan plan = gains_plan(evaluations);
  const FrontResult found = search_front(plan, grounds);
  Plan draws;
  draws.meshes = {"."};
  draws.poses = {"."};
  draws.methods = {Method::paper};
  draws.fingers = {plan.base.finger};
  draws.base = plan.base;
  draws.ranges = plan.ranges;
  draws.sampling = Sampling::random;
  draws.samples = random;
  const Result<Cells> cells = Cells::of(draws);
  REQUIRE(cells);
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < random; ++i)
    trials.push_back(try_preset(plan, grounds, cells->preset(cells->at(i)), false));
  std::array<double, 2> reference{};
  for (const std::size_t i : front_of(trials))
    for (std::size_t k = 0; k < 2; ++k) reference[k] = std::max(reference[k], 1.1 * trials[i].objectives[k]);
  const double share = hypervolume(found.trials, reference) / hypervolume(trials, reference);
  MESSAGE("hypervolume of ", evaluations, " trials over that of ", random, " random ones: ", share);
  return share;
}

TEST_CASE("a search covers 99 % of what ten times as many random presets cover") {
  if (!has_front_search()) {
    MESSAGE("skipped: built without pagmo");
    return;
  }
  const auto scene = *ContactScene::build(*ContactMesh::build(*generate_mesh("torus"), {}));
  const bool whole = std::getenv("TANGENT_FRONTS") != nullptr;  // as the page has it: 500 against 10,000
  CHECK(share_of_random({ground(scene, whole ? 2000 : 60)}, whole ? 500 : 200, whole ? 10000 : 2000) >= 0.99);
}

}  // namespace
}  // namespace tangent::sweep
