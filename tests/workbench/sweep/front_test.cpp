#include "workbench/sweep/front.h"

#include "core/io/scene_file.h"
#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"
#include "tests/support/meshes.h"
#include "workbench/session/exploration_poses.h"
#include "workbench/sweep/front_search.h"
#include "workbench/sweep/race.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <sstream>

namespace tangent::sweep {

using test::approx;
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

TEST_CASE("a preset that finds no contact does not have the smallest error") {
  const Objective p50 = *find_objective("error_p50_m"), p99 = *find_objective("error"),
                  worst = *find_objective("error_worst_m"), planes = *find_objective("mean_iterations");
  CellNumbers numbers;
  numbers.ticks = 1000;
  numbers.error_p50_m = numbers.error_p99_m = numbers.error_worst_m = 1e-7;
  numbers.mean_iterations = 3.0;
  numbers.unconverged = 400;
  numbers.facing = 100;
  for (const Objective& error : {p50, p99, worst}) CHECK(error.lacking(numbers) == 0.0);
  numbers.unconverged = 900;
  for (const Objective& error : {p50, p99, worst}) CHECK(error.lacking(numbers) == 1.0);
  CHECK_FALSE(parse_constraint("error <= 5 um")->holds(numbers));
  CHECK(planes.lacking(numbers) == 0.0);
  CHECK(parse_constraint("mean_iterations <= 5")->holds(numbers));
}

TEST_CASE("the hypervolume is the area up to the reference") {
  CHECK(hypervolume(std::vector<Trial>{point(0, 0)}, {2.0, 4.0}) == 1.0);
  CHECK(hypervolume(std::vector<Trial>{point(1, 2)}, {2.0, 4.0}) == approx(0.25));
  CHECK(hypervolume(std::vector<Trial>{point(0.5, 3), point(1, 1), point(1.5, 0.5)}, {2.0, 4.0}) ==
        approx((1.5 * 1.0 + 1.0 * 2.0 + 0.5 * 0.5) / 8.0));
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
  const auto quick = parse_constraint("p99_time <= 20 us"), near = parse_constraint("error<=0.5um");
  REQUIRE(quick);
  REQUIRE(near);
  CHECK(quick->text() == "p99_time <= 20 us");
  CHECK(near->of.name() == "error_p99_m");
  CHECK(near->most == approx(5e-7));
  CHECK(parse_constraint("mean_time <= 900 ns")->most == approx(0.9));
  numbers.p99_counted_us = 15.0;
  CHECK(quick->holds(numbers));
  CHECK(!quick->holds(numbers, {1.0, 1.5}));  // a tick takes half as long again here
  for (const ObjectiveName& known : kObjectiveNames) CHECK(find_objective(known.name)->column->name == known.column);
  CHECK(few->text() == "p99_iterations <= 5");
  for (const char* wrong :
       {"", "unconverged", "unconverged < 1", "unconverged = 1", "unconverged <= x", "a <= 1", "unconverged <= -1",
        "<= 1", "p99_time <= 20", "p99_time <= 20 mm", "unconverged <= 1 us", "unconverged >= 1"})
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

/// Ticks of the path all over a generated mesh: pieces of it, in all about so many.
FrontGround pieces(std::shared_ptr<const ContactScene> scene, std::size_t ticks) {
  auto poses = exploration_poses(*scene, Finger{}, ExplorationKind::around, ExplorationPace::varied);
  REQUIRE(poses);
  const std::size_t blocks = std::max<std::size_t>(1, ticks / kBlockTicks), each = ticks / blocks;
  std::vector<TickInput> some;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t first = std::min(b * poses->poses.size() / blocks, poses->poses.size() - each);
    some.insert(some.end(), poses->poses.begin() + static_cast<std::ptrdiff_t>(first),
                poses->poses.begin() + static_cast<std::ptrdiff_t>(first + each));
  }
  return {{std::move(scene), std::make_shared<const std::vector<TickInput>>(std::move(some))}, blocks * each};
}

std::shared_ptr<const ContactScene> generated(const std::string& name, double rounding_m = 0.0) {
  GenerateOptions options;
  options.rounding_m = rounding_m;
  return *ContactScene::build(*ContactMesh::build(*generate_mesh(name, options), {}));
}

/// The corner that both fronts are measured up to: a tenth beyond the worst of their points.
std::array<double, 2> corner_of(std::span<const Trial> trials) {
  std::array<double, 2> out{};
  for (const std::size_t i : front_of(trials))
    for (std::size_t k = 0; k < 2; ++k) out[k] = std::max(out[k], 1.1 * trials[i].objectives[k]);
  return out;
}

TEST_CASE("one number alone is searched, too") {
  const std::vector<FrontGround> grounds{
      ground(*ContactScene::build(*ContactMesh::build(*generate_mesh("torus"), {})), 60)};
  FrontPlan plan = gains_plan(80);
  plan.objectives.resize(1);
  const FrontResult found = search_front(plan, grounds);
  CHECK(found.trials.size() == 80);
  CHECK(front_of(found.trials).size() == 1);
  CHECK(found.trials.back().objectives.size() == 1);
}

TEST_CASE("a race gives the front that trials on all ticks give, for fewer ticks") {
  const std::vector<FrontGround> grounds{pieces(generated("torus"), 12 * kBlockTicks)};
  FrontPlan plan = gains_plan(120);
  plan.constraints = {*parse_constraint("unconverged = 0")};
  plan.starts = {plan.base};
  plan.starts[0].solver.gain_curvature_m = plan.base.finger.radius_m;
  const FrontResult raced = search_front(plan, grounds);
  plan.race = false;
  const FrontResult whole = search_front(plan, grounds);
  CHECK(whole.ticks == whole.without_race);
  CHECK(raced.without_race == whole.without_race);
  MESSAGE("ticks solved: ", raced.ticks, " of ", whole.ticks);
  CHECK(raced.ticks < whole.ticks * 9 / 10);
  const auto corner = corner_of(whole.trials);
  CHECK(hypervolume(raced.trials, corner) >= 0.99 * hypervolume(whole.trials, corner));
  // Those that saw all ticks have the numbers that they have by themselves, and no other is on the front.
  for (const std::size_t i : front_of(raced.trials)) CHECK(!raced.trials[i].dropped);
  const Trial& one = raced.trials[front_of(raced.trials).front()];
  Preset preset = plan.base;
  for (std::size_t r = 0; r < plan.ranges.size(); ++r) plan.ranges[r].key->set(preset, one.values[r]);
  CHECK(try_preset(plan, grounds, preset, false).objectives == one.objectives);
}

TEST_CASE("a race is the same with any number of threads") {
  const std::vector<FrontGround> grounds{pieces(generated("torus"), 6 * kBlockTicks)};
  FrontPlan plan = gains_plan(60);
  plan.starts = {plan.base};
  const FrontResult two = search_front(plan, grounds);
  plan.threads = 1;
  const FrontResult one = search_front(plan, grounds);
  REQUIRE(one.trials.size() == two.trials.size());
  int dropped = 0;
  for (std::size_t i = 0; i < one.trials.size(); ++i) {
    CHECK(one.trials[i].values == two.trials[i].values);
    CHECK(one.trials[i].objectives == two.trials[i].objectives);
    CHECK(one.trials[i].ticks == two.trials[i].ticks);
    dropped += one.trials[i].dropped;
  }
  CHECK(dropped > 0);
}

TEST_CASE("over several grounds an objective is that of the worst, or the mean, and a constraint holds on each") {
  std::vector<FrontGround> grounds{pieces(generated("torus"), 200), pieces(generated("icosphere"), 200)};
  grounds.push_back(grounds[0]);
  grounds[2].finger = Finger{};
  grounds[2].finger->radius_m *= 0.4;
  FrontPlan plan = gains_plan(10);
  const Trial worst = try_preset(plan, grounds, plan.base, false);
  plan.over_grounds = OverGrounds::mean;
  const Trial mean = try_preset(plan, grounds, plan.base, false);
  REQUIRE(worst.ground_numbers.size() == 3);
  double most = 0.0, sum = 0.0;
  for (std::size_t g = 0; g < 3; ++g) {
    FrontPlan alone = plan;
    if (grounds[g].finger) alone.base.finger = *grounds[g].finger;
    const Trial one = try_preset(alone, {grounds[g]}, alone.base, false);
    CHECK(one.numbers == worst.ground_numbers[g]);
    most = std::max(most, one.objectives[0]);
    sum += one.objectives[0];
  }
  CHECK(worst.objectives[0] == most);
  CHECK(mean.objectives[0] == approx(sum / 3.0));
  CHECK(worst.ground_numbers[2].force_change_mean_n != worst.ground_numbers[0].force_change_mean_n);
  plan.constraints = {Constraint{plan.objectives[0], most - 1e-9}};
  CHECK(try_preset(plan, grounds, plan.base, false).missed > 0.0);
  plan.constraints[0].most = most;
  CHECK(try_preset(plan, grounds, plan.base, false).missed == 0.0);
}

TEST_CASE("a search that is told to stop keeps what is done, at once") {
  const std::vector<FrontGround> grounds{pieces(generated("torus"), 4 * kBlockTicks)};
  FrontPlan plan = gains_plan(60);
  plan.race = false;
  std::atomic<int> tried{0};
  plan.tried = [&](const Trial&) { ++tried; };
  plan.stop = [&] { return tried >= 5; };
  const FrontResult stopped = search_front(plan, grounds);
  CHECK(stopped.stopped);
  CHECK(stopped.trials.size() >= 5);
  CHECK(stopped.trials.size() <= 7);  // those of the other thread at that moment
  for (const Trial& trial : stopped.trials) CHECK(trial.objectives.size() == 2);
}

/// Random presets, as many as the plan has evaluations, on its threads.
FrontResult search_random(FrontPlan plan, const std::vector<FrontGround>& grounds) {
  Plan draws;
  draws.meshes = {"."};
  draws.poses = {"."};
  draws.methods = {plan.base.solver.method};
  draws.fingers = {plan.base.finger};
  draws.base = plan.base;
  draws.ranges = plan.ranges;
  draws.sampling = Sampling::random;
  draws.samples = plan.evaluations;
  draws.seed = plan.seed;
  const Result<Cells> cells = Cells::of(draws);
  REQUIRE(cells);
  for (std::size_t i = 0; i < plan.evaluations; ++i) plan.starts.push_back(cells->preset(cells->at(i)));
  return search_front(plan, grounds);
}

/// Shares of the hypervolume of `random` random presets that searches with `evaluations` reach, a seed each, from
/// theory's gains on, as `tune` does.
std::vector<double> shares_of_random(const std::string& name, const std::vector<FrontGround>& grounds,
                                     std::size_t evaluations, std::size_t random, std::uint64_t first_seed,
                                     std::size_t seeds) {
  FrontPlan draws = gains_plan(random);
  draws.evolve = draws.race = false;
  draws.seed = 12345;
  const FrontResult trials = search_random(draws, grounds);
  const auto corner = corner_of(trials.trials);
  FrontPlan plan = gains_plan(evaluations);
  plan.starts = {plan.base};
  plan.starts[0].solver.gain_curvature_m = plan.base.finger.radius_m;
  std::vector<double> out;
  for (plan.seed = first_seed; out.size() < seeds; ++plan.seed) {
    out.push_back(hypervolume(search_front(plan, grounds).trials, corner) / hypervolume(trials.trials, corner));
    MESSAGE(name, ", seed ", plan.seed, ": ", out.back());
  }
  double sum = 0.0;
  for (const double share : out) sum += share;
  MESSAGE(name, ": hypervolume of ", evaluations, " trials over that of ", random, " random ones, of ", seeds,
          " seeds: mean ", sum / static_cast<double>(seeds), ", least ", *std::min_element(out.begin(), out.end()),
          ", ", std::count_if(out.begin(), out.end(), [](double share) { return share < 0.99; }), " below 0.99");
  return out;
}

TEST_CASE("a search covers 99 % of what ten times as many random presets cover") {
  if (!has_front_search()) {
    MESSAGE("skipped: built without pagmo");
    return;
  }
  if (const char* const meshes = std::getenv("TANGENT_FRONTS"); meshes != nullptr) {  // as the page has it
    const char* const said = std::getenv("TANGENT_SEEDS");                            // FIRST COUNT
    std::istringstream names(meshes), numbers(said != nullptr ? said : "1 1");
    std::uint64_t first = 1;
    std::size_t seeds = 1;
    REQUIRE(static_cast<bool>(numbers >> first >> seeds));
    REQUIRE(seeds > 0);
    for (std::string name; names >> name;) {
      const bool file = name.find('/') != std::string::npos;
      SceneOptions reading;
      reading.mesh.fit_m = 0.08;
      const auto scene = file ? *load_scene(name, reading) : generated(name, 1.5e-3 * (name != "torus"));
      for (const double share : shares_of_random(name, {pieces(scene, 1000)}, 500, 10'000, first, seeds))
        CHECK(share >= 0.99);
    }
    return;
  }
  CHECK(shares_of_random("cube", {pieces(generated("cube", 1.5e-3), 60)}, 500, 10'000, 1, 1)[0] >= 0.99);
}

TEST_CASE("the share of a value in a range is where the range has it") {
  const FrontPlan plan = gains_plan(8);
  for (const Range& range : plan.ranges)
    for (const double share : {0.0, 0.3, 1.0})
      CHECK(*range.share_of(range.at(share)) == approx(share).epsilon(1e-12).scale(1.0));
  CHECK(!plan.ranges[0].share_of(0.49));
  CHECK(!plan.ranges[3].share_of(0.0));
  Range list = plan.ranges[0];
  list.values = {0.8, 1.0, 1.2};
  CHECK(list.at(*list.share_of(1.0)) == 1.0);
  CHECK(!list.share_of(0.9));
}

}  // namespace
}  // namespace tangent::sweep
