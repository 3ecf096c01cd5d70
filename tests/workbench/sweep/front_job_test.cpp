#include "workbench/sweep/front_job.h"

#include "tests/workbench/sweep/ground_fixture.h"

namespace tangent::sweep {
namespace {

using testing::torus_ground;
using Load = std::function<Result<Ground>(const std::function<bool()>&)>;

FrontPlan job_plan(std::size_t evaluations) {
  FrontPlan plan;
  plan.base.solver.method = Method::paper;
  for (const auto& [key, to] : {std::pair{"solver.gain_curvature_m", 0.08}, {"solver.tolerance_m", 1e-4}}) {
    Range range;
    range.key = find_preset_key(key);
    range.from = 1e-8;
    range.to = to;
    range.logarithmic = range.key->logarithmic;
    plan.ranges.push_back(range);
  }
  plan.objectives = {*find_objective("mean_iterations"), *find_objective("error_p99_m")};
  plan.constraints = {*parse_constraint("unconverged = 0")};
  plan.starts = {plan.base};
  plan.evaluations = evaluations;
  return plan;
}

Load load_torus(std::size_t ticks) {
  return [ground = torus_ground(ticks)](const std::function<bool()>&) { return ground; };
}

std::vector<Trial> all_of(FrontJob& job, std::size_t at_a_time) {
  std::vector<Trial> out;
  while (job.running()) {
    std::vector<Trial> some = job.take(at_a_time);
    CHECK(some.size() <= at_a_time);
    out.insert(out.end(), some.begin(), some.end());
  }
  return out;
}

TEST_CASE("a front in the background gives the trials of the search, one after the other, and a verdict") {
  for (const bool evolve : {true, false}) {
    FrontPlan plan = job_plan(44);
    plan.evolve = evolve;
    FrontJob job;
    job.start(plan, load_torus(80));
    const std::vector<Trial> grown = all_of(job, 7);
    const FrontResult found = search_front(plan, {{torus_ground(80), 60}});
    REQUIRE(grown.size() == found.trials.size());
    for (std::size_t i = 0; i < grown.size(); ++i) {
      CHECK(grown[i].values == found.trials[i].values);
      CHECK(grown[i].objectives == found.trials[i].objectives);
    }
    REQUIRE(job.ground() != nullptr);
    CHECK(job.ground()->motion->size() == 80);
    REQUIRE(job.verdict());
    CHECK(job.verdict()->mine.objectives.size() == 2);
    CHECK(job.verdict()->mine.numbers.ticks == 20);
    CHECK(job.verdict()->chosen < grown.size());
  }
}

TEST_CASE("a front that is cancelled keeps what was taken, ends at once, and another can be started") {
  FrontJob job;
  job.start(job_plan(5000), load_torus(2000));
  const std::vector<Trial> some = job.take(3);
  CHECK(some.size() == 3);
  job.cancel();
  CHECK_FALSE(job.running());
  CHECK(job.take().empty());
  CHECK_FALSE(job.verdict());
  job.start(job_plan(12), load_torus(100));
  CHECK(all_of(job, 5).size() == 12);
  job.start(job_plan(5000), load_torus(2000));
  job.take(1);  // and is left running: the job ends with its owner
}

TEST_CASE("a search that is told to stop keeps whole trials only") {
  FrontPlan plan = job_plan(200);
  int tried = 0;
  plan.tried = [&tried](const Trial&) { ++tried; };
  plan.stop = [&tried] { return tried >= 20; };
  const FrontResult found = search_front(plan, {{torus_ground(60), 60}});
  CHECK(found.stopped);
  CHECK(found.trials.size() == 20);
  for (const Trial& trial : found.trials) CHECK(trial.objectives.size() == 2);
}

TEST_CASE("where no motion can be had, the job says why and ends") {
  FrontJob job;
  job.start(job_plan(20), [](const std::function<bool()>&) -> Result<Ground> { return fail("no such mesh"); });
  CHECK(all_of(job, 4).empty());
  CHECK(job.take_failure().find("no such mesh") != std::string::npos);
  CHECK(job.take_failure().empty());
  job.start(job_plan(20), load_torus(3));
  CHECK(all_of(job, 4).empty());
  CHECK(job.take_failure().find("too short") != std::string::npos);
}

}  // namespace
}  // namespace tangent::sweep
