#include "tests/support/approx.h"
#include "tests/workbench/sweep/sweep_fixture.h"

#include <atomic>

namespace tangent::sweep {

using test::approx;
namespace {

using testing::SmallSweep;

TEST_CASE("the numbers are the same with any number of threads, after a stop, and in any shards") {
  const SmallSweep sweep;
  const SweepOutcome outcome = sweep.solve("one.sqlite");
  CHECK(outcome.cells == 16);
  CHECK(outcome.solved == 16);
  CHECK(outcome.failures.cells == 0);
  const auto rows = sweep.rows("one.sqlite");
  REQUIRE(rows.size() == 16);

  SweepOptions four;
  four.threads = 4;
  sweep.solve("four.sqlite", four);
  CHECK(sweep.rows("four.sqlite") == rows);

  std::atomic<bool> enough{false};
  SweepOptions some;
  some.threads = 2;
  some.stop = [&] { return enough.load(); };
  some.progress = [&](const SweepProgress& p) { enough.store(p.done >= 5); };
  const SweepOutcome stopped = sweep.solve("some.sqlite", some);
  CHECK(stopped.stopped);
  CHECK(stopped.solved < 16);
  const SweepOutcome rest = sweep.solve("some.sqlite");
  CHECK(rest.before == stopped.solved);
  CHECK(rest.before + rest.solved == 16);
  CHECK(sweep.rows("some.sqlite") == rows);

  for (const std::uint64_t shards : {1, 3, 16}) {
    const std::string folder = "in" + std::to_string(shards), merged = folder + ".sqlite";
    REQUIRE(write_plan_folder(sweep.file(folder), sweep.plan(), shards, {}));
    const Result<PlanFolder> divided = open_plan_folder(sweep.file(folder));
    REQUIRE_MESSAGE(divided, divided.error().message());
    for (std::uint64_t shard = 0; shard < shards; ++shard) REQUIRE(run_shard(*divided, shard, {}));
    REQUIRE(run_shard(*divided, 0, {}));  // once more: nothing to do
    const Result<MergeOutcome> joined = merge_shards(*divided, sweep.file(merged), {});
    REQUIRE_MESSAGE(joined, joined.error().message());
    CHECK(sweep.rows(merged) == rows);
    REQUIRE(merge_shards(*divided, sweep.file(merged), {}));  // and merged once more
    CHECK(sweep.rows(merged) == rows);
  }
}

TEST_CASE("a cell's numbers are those of solving its motion by itself") {
  const SmallSweep sweep;
  const Cells cells = sweep.cells();
  Inputs inputs(cells.plan());
  const Cell cell = cells.at(cells.per_group() + 1);  // torus, paper
  const Result<Ground> ground = inputs.ground(cell.mesh, cell.poses, cell.finger);
  REQUIRE(ground);
  Stepper fresh(ground->scene), exact(ground->scene);
  const auto numbers = measure_cell(fresh, exact, cells.preset(cell), *ground->motion);
  REQUIRE(numbers);
  CHECK(measure_cell(fresh, exact, cells.preset(cell), *ground->motion) == numbers);  // a used stepper changes nothing

  Stepper stepper(ground->scene);
  TickState state;
  std::uint64_t unconverged = 0, planes = 0;
  for (const TickInput& input : *ground->motion) {
    const TickOutput output = stepper.step(cells.preset(cell), input, state);
    unconverged += output.status == TickStatus::unconverged;
    planes += static_cast<std::uint64_t>(output.iterations);
  }
  CHECK(numbers->ticks == SmallSweep::kTicks);
  CHECK(numbers->unconverged == unconverged);
  CHECK(numbers->mean_iterations == approx(static_cast<double>(planes) / SmallSweep::kTicks));
  CHECK(numbers->compared > 0);
  CHECK(numbers->error_worst_m > 0.0);
  CHECK(numbers->error_worst_m < 1e-5);
  CHECK(!measure_cell(fresh, exact, cells.preset(cell), *ground->motion, [] { return true; }));
}

TEST_CASE("facets are as far from the exact contact as the surface bends, and not compared with themselves") {
  const SmallSweep sweep;
  const Cells cells = sweep.cells();
  Inputs inputs(cells.plan());
  const std::uint64_t of_torus = cells.per_group();
  const auto ground = inputs.ground(1, 0, 0);
  REQUIRE(ground);
  Stepper stepper(ground->scene), exact(ground->scene);
  Preset facet = cells.preset(cells.at(of_torus));
  facet.solver.method = Method::facet;
  const auto numbers = measure_cell(stepper, exact, facet, *ground->motion);
  REQUIRE(numbers);
  CHECK(numbers->compared > 0);
  CHECK(numbers->error_p50_m > 1e-5);
}

TEST_CASE("a mesh that can't be read leaves its cells without numbers, and the others with theirs") {
  const SmallSweep sweep;
  const auto whole = (static_cast<void>(sweep.solve("whole.sqlite")), sweep.rows("whole.sqlite"));
  sweep.write("cube.obj", "v 1 2\n");
  const SweepOutcome outcome = sweep.solve("broken.sqlite");
  CHECK(outcome.failures.cells == 8);
  REQUIRE(outcome.failures.reasons.size() == 1);
  CHECK(outcome.failures.reasons[0].why.find("cube.obj:1") != std::string::npos);
  const auto rows = sweep.rows("broken.sqlite");
  REQUIRE(rows.size() == 16);
  CHECK(rows[0].find("cube.obj:1") != std::string::npos);
  CHECK(std::vector(rows.begin() + 8, rows.end()) == std::vector(whole.begin() + 8, whole.end()));
}

TEST_CASE("cells without numbers are told again when a sweep, a shard or a merge is run again over them") {
  const SmallSweep sweep("ticks = 20\n");
  sweep.write("cube.obj", "v 1 2\n");
  REQUIRE(write_plan_folder(sweep.file("dir"), sweep.plan(), 2, {}));
  const PlanFolder divided = *open_plan_folder(sweep.file("dir"));
  for (const std::uint64_t solved : {16, 0}) {
    CAPTURE(solved);
    const SweepOutcome here = sweep.solve("here.sqlite"), first = *run_shard(divided, 0, {}),
                       second = *run_shard(divided, 1, {}), joined = *merge_shards(divided, sweep.file("m.sqlite"), {});
    CHECK(here.solved == solved);
    CHECK(joined.solved == solved);
    for (const SweepOutcome& outcome : {here, first, joined}) {
      CHECK(outcome.failures.cells == 8);
      REQUIRE(outcome.failures.reasons.size() == 1);
      CHECK(outcome.failures.reasons[0].first == 0);
      CHECK(outcome.failures.reasons[0].why.find("cube.obj:1") != std::string::npos);
    }
    CHECK(second.failures.cells == 0);
  }
}

TEST_CASE("times that a shard has lost are counted when it is merged, and the shard is named") {
  const SmallSweep sweep("ticks = 20\n");
  JobScripts scripts;
  scripts.times = 2;
  REQUIRE(write_plan_folder(sweep.file("dir"), sweep.plan(), 2, scripts));
  const PlanFolder divided = *open_plan_folder(sweep.file("dir"));
  CHECK(divided.times == 2);
  for (const std::uint64_t shard : {0, 1}) REQUIRE(run_shard(divided, shard, {}));
  const auto none = merge_shards(divided, sweep.file("none.sqlite"), {});
  REQUIRE(none);
  CHECK(none->lacking.cells == 16);  // the plan asks for them
  CHECK(none->lacking.shards == 2);
  PlanFolder unasked = divided;
  unasked.times = 0;
  CHECK(merge_shards(unasked, sweep.file("unasked.sqlite"), {})->lacking.cells == 0);

  for (const std::uint64_t shard : {0, 1}) REQUIRE(time_shard(divided, shard, 2, {}));
  CHECK(merge_shards(divided, sweep.file("all.sqlite"), {})->lacking.cells == 0);
  std::string lines = testing::bytes_of(divided.shard_file(1));
  for (int lost = 0; lost < 3; ++lost) lines.erase(lines.rfind('\n', lines.size() - 2) + 1);
  std::ofstream(divided.shard_file(1), std::ios::binary) << lines;
  const auto merged = merge_shards(unasked, sweep.file("some.sqlite"), {});
  REQUIRE(merged);
  CHECK(merged->lacking.cells == 3);
  CHECK(merged->lacking.shards == 1);
  CHECK(merged->lacking.first_shard == 1);
  CHECK(merged->lacking.first_cells == 3);
  CHECK(merge_shards(unasked, sweep.file("all.sqlite"), {})->lacking.cells == 0);  // this one has them
}

TEST_CASE("results of another plan, of changed meshes and other files are not gone on with") {
  const SmallSweep sweep;
  static_cast<void>(sweep.solve("one.sqlite"));
  const auto open = [&](const Plan& plan, const char* name) {
    const Cells cells = *Cells::of(plan);
    const auto file = ResultsFile::open(sweep.file(name), cells, plan_digest(plan));
    return file ? std::string("opened") : file.error().message();
  };
  CHECK(open(sweep.plan(), "one.sqlite") == "opened");
  Plan other = sweep.plan();
  other.ticks = 100;
  CHECK(open(other, "one.sqlite").find("another plan") != std::string::npos);
  REQUIRE(write_obj(*generate_mesh("sphere"), sweep.file("cube.obj"), 1e-3));
  CHECK(open(sweep.plan(), "one.sqlite").find("another plan") != std::string::npos);
  sweep.write("empty.sqlite", "");  // as it is when a sweep is killed at its very beginning
  CHECK(open(sweep.plan(), "empty.sqlite") == "opened");
  sweep.write("text.sqlite", "these are no results");
  CHECK(open(sweep.plan(), "text.sqlite").find("text.sqlite") != std::string::npos);
  CHECK(open(sweep.plan(), "nowhere/new.sqlite").find("can't be created") != std::string::npos);
}

TEST_CASE("every cell is timed once, against the first of its group") {
  const SmallSweep sweep("ticks = 40\n");
  static_cast<void>(sweep.solve("one.sqlite"));
  const Cells cells = sweep.cells();
  auto file = ResultsFile::open(sweep.file("one.sqlite"), cells, plan_digest(cells.plan()));
  REQUIRE(file);
  const auto timed = time_sweep(cells, *file, 2, 30, {});
  REQUIRE(timed);
  CHECK(*timed == 16);
  CHECK(*time_sweep(cells, *file, 2, 30, {}) == 0);
  REQUIRE(file->finish());
  Result<Database> database = Database::open(sweep.file("one.sqlite"));
  REQUIRE(database);
  CHECK(*database->whole_of("SELECT count(*) FROM timings WHERE against = cell / 8 * 8 AND ns > 0 AND low <= ratio") ==
        16);
}

TEST_CASE("a shard's cells are timed after it, once, and merged with the machine that they were timed on") {
  const SmallSweep sweep("ticks = 40\n");
  REQUIRE(write_plan_folder(sweep.file("dir"), sweep.plan(), 2, {}));
  const PlanFolder divided = *open_plan_folder(sweep.file("dir"));
  for (const std::uint64_t shard : {0, 1}) {
    REQUIRE(run_shard(divided, shard, {}));
    const auto timed = time_shard(divided, shard, 2, {});
    REQUIRE(timed);
    CHECK(*timed == 8);
    CHECK(*time_shard(divided, shard, 2, {}) == 0);
  }
  CHECK(!time_shard(divided, 2, 2, {}));
  static_cast<void>(sweep.solve("one.sqlite"));
  for (int again = 0; again < 2; ++again) REQUIRE(merge_shards(divided, sweep.file("merged.sqlite"), {}));
  CHECK(sweep.rows("merged.sqlite") == sweep.rows("one.sqlite"));
  Result<Database> database = Database::open(sweep.file("merged.sqlite"));
  REQUIRE(database);
  CHECK(*database->whole_of("SELECT count(*) FROM timings WHERE against = cell / 8 * 8 AND ns > 0 AND low <= ratio") ==
        16);
  CHECK(*database->text_of("SELECT DISTINCT machine FROM timings") == machine_name());
}

TEST_CASE("results on a full disk keep the cells that were committed, say so, and are gone on with") {
  const SmallSweep sweep;
  static_cast<void>(sweep.solve("whole.sqlite"));
  const Cells cells = sweep.cells();
  {
    auto file = ResultsFile::open(sweep.file("full.sqlite"), cells, plan_digest(cells.plan()));
    REQUIRE(file);
    Inputs inputs(cells.plan());
    std::vector<CellResult> results;
    REQUIRE(run_cells(cells, inputs, 0, 4, std::vector<bool>(4, false),
                      [&](const CellResult& result) { return results.push_back(result), Status{}; }, {}));
    for (std::size_t i = 0; i < 3; ++i) REQUIRE(file->add(results[i]));
    REQUIRE(file->commit());
    const testing::FullDisk full(std::filesystem::file_size(sweep.file("full.sqlite-wal")));
    const Status added = file->add(results[3]);
    const Status failed = added ? file->commit() : added;
    REQUIRE(!failed);
    CHECK(failed.error().message().find("full.sqlite") != std::string::npos);
  }
  const SweepOutcome rest = sweep.solve("full.sqlite");
  CHECK(rest.before == 3);
  CHECK(sweep.rows("full.sqlite") == sweep.rows("whole.sqlite"));
}

TEST_CASE("results and shards of an older program are refused by name") {
  const SmallSweep sweep;
  static_cast<void>(sweep.solve("old.sqlite"));
  {
    Result<Database> database = Database::open_to_write(sweep.file("old.sqlite"));
    REQUIRE(database);
    REQUIRE(database->run("PRAGMA user_version=1"));
  }
  const Cells cells = sweep.cells();
  const auto file = ResultsFile::open(sweep.file("old.sqlite"), cells, plan_digest(cells.plan()));
  REQUIRE(!file);
  CHECK(file.error().message().find("old.sqlite: is of an older program") != std::string::npos);
}

TEST_CASE("two solutions of a cell with other numbers are told apart") {
  const SmallSweep sweep;
  const Cells cells = sweep.cells();
  auto file = ResultsFile::open(sweep.file("one.sqlite"), cells, "digest");
  REQUIRE(file);
  CellResult result;
  result.numbers.ticks = 3;
  REQUIRE(file->add(result));
  CHECK(file->add(result));
  result.numbers.error_p50_m = 1e-300;
  const Status ok = file->add(result);
  REQUIRE(!ok);
  CHECK(ok.error().message().find("solved twice") != std::string::npos);
  result.cell = 16;
  CHECK(!file->add(result));
}

TEST_CASE(
    "cells without numbers are solved again when asked, also where their mesh was mended, and nothing else may "
    "change") {
  const SmallSweep sweep, whole;
  const std::string cube = testing::bytes_of(sweep.file("cube.obj"));
  const auto expected = [&] {
    static_cast<void>(whole.solve("one.sqlite"));
    return whole.rows("one.sqlite");
  }();
  sweep.write("cube.obj", "no mesh\n");
  const SweepOutcome first = sweep.solve("one.sqlite");
  CHECK(first.solved == 16);
  CHECK(first.failed == 8);
  CHECK(first.failures.cells == 8);
  const auto again = [&](FailedCells failed) {
    const Cells cells = sweep.cells();
    auto file = ResultsFile::open(sweep.file("one.sqlite"), cells, plan_digest(cells.plan()), failed);
    if (!file) return file.error().message();
    const Result<SweepOutcome> outcome = run_sweep(cells, *file, {});
    REQUIRE(outcome);
    REQUIRE(file->finish());
    return std::to_string(outcome->before) + " there, " + std::to_string(outcome->solved) + " solved, " +
           std::to_string(outcome->failed) + " failed, " + std::to_string(outcome->failures.cells) + " in all";
  };
  CHECK(again(FailedCells::keep) == "16 there, 0 solved, 0 failed, 8 in all");
  CHECK(again(FailedCells::again) == "8 there, 8 solved, 8 failed, 8 in all");
  const std::string torus = testing::bytes_of(sweep.file("torus.obj"));
  sweep.write("torus.obj", torus + "# changed\n");
  CHECK(again(FailedCells::again).find("torus.obj: has changed since cells were solved on it") != std::string::npos);
  sweep.write("torus.obj", torus);
  sweep.write("cube.obj", cube);
  CHECK(again(FailedCells::keep).find("another plan") != std::string::npos);
  CHECK(again(FailedCells::again) == "8 there, 8 solved, 0 failed, 0 in all");
  CHECK(sweep.rows("one.sqlite") == expected);
  CHECK(again(FailedCells::keep) == "16 there, 0 solved, 0 failed, 0 in all");
}

}  // namespace
}  // namespace tangent::sweep
