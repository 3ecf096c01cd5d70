#include "workbench/sweep/tuning_file.h"

#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/sweep/ground_fixture.h"
#include "workbench/sweep/front_search.h"
#include "workbench/sweep/tuning_lines.h"

#include <limits>

namespace tangent::sweep {
namespace {

namespace fs = std::filesystem;
using tangent::testing::contains;
using tangent::testing::FullDisk;
using tangent::testing::read_text;
using tangent::testing::TempFolder;

FrontPlan kept_plan() {
  FrontPlan plan;
  plan.base = testing::paper_preset(0.02);
  Range range;
  range.key = find_preset_key("solver.gain_curvature_m");
  range.to = 0.08;
  plan.ranges = {range};
  range.key = find_preset_key("solver.tolerance_m");
  range.from = 1e-8;
  range.to = 1e-4;
  range.logarithmic = true;
  plan.ranges.push_back(range);
  plan.objectives = {*find_objective("mean_iterations"), *find_objective("error")};
  plan.constraints = {*parse_constraint("unconverged <= 100")};
  plan.starts = {plan.base};
  plan.evaluations = 60;
  plan.threads = 2;
  return plan;
}

std::vector<FrontGround> kept_grounds() {
  return {{testing::torus_ground(3000), 2600}, {testing::torus_ground(600), 500}};
}

/// The search with the file; counts what was tried anew.
struct KeptSearch {
  FrontResult found;
  std::atomic<std::size_t> anew{0};

  KeptSearch(FrontPlan plan, const std::vector<FrontGround>& grounds, TuningFile& file) {
    plan.known = [&](std::size_t number, const auto& values) { return file.trial(number, values); };
    plan.keep = [&](std::size_t number, const RacedTrial& trial) {
      ++anew;
      file.keep(number, trial);
    };
    plan.stop = [&] { return file.failed(); };
    found = search_front(plan, grounds);
  }
};

bool same(const Trial& a, const Trial& b) {
  return a.values == b.values && a.numbers == b.numbers && a.ground_numbers == b.ground_numbers &&
         a.objectives == b.objectives && a.missed == b.missed && a.ticks == b.ticks && a.dropped == b.dropped;
}

bool same(const FrontResult& a, const FrontResult& b) {
  return a.ticks == b.ticks && a.without_race == b.without_race && a.trials.size() == b.trials.size() &&
         std::equal(a.trials.begin(), a.trials.end(), b.trials.begin(),
                    [](const Trial& x, const Trial& y) { return same(x, y); });
}

TEST_CASE("a search for a front that was killed at any byte of its file goes on to the same trials, solving the rest") {
  const TempFolder folder;
  const fs::path path = folder.file("p.toml.tuning");
  const FrontPlan plan = kept_plan();
  const std::vector<FrontGround> grounds = kept_grounds();
  const std::string digest = tuning_digest(plan, grounds);
  const FrontResult whole = search_front(plan, grounds);
  CHECK(std::any_of(whole.trials.begin(), whole.trials.end(), [](const Trial& t) { return t.dropped; }));
  std::string text;
  {
    auto file = TuningFile::open(path, digest);
    REQUIRE(file);
    const KeptSearch kept(plan, grounds, **file);
    CHECK(same(kept.found, whole));
    CHECK(kept.anew == whole.trials.size());
    text = read_text(path);
  }
  CHECK(fs::exists(path));
  for (const double share : {0.003, 0.6, 1.0}) {
    const std::string left = text.substr(0, static_cast<std::size_t>(share * static_cast<double>(text.size())));
    CAPTURE(left.size());
    folder.write("p.toml.tuning", left);
    auto file = TuningFile::open(path, digest);
    REQUIRE(file);
    const auto lines = static_cast<std::size_t>(std::count(left.begin(), left.end(), '\n'));
    CHECK((*file)->found() == (lines > 0 ? lines - 1 : 0));
    const KeptSearch kept(plan, grounds, **file);
    CHECK(same(kept.found, whole));
    CHECK(kept.anew == whole.trials.size() - (*file)->found());
  }
}

TEST_CASE("while a tuning runs, another one on the same file is refused, whatever it is of") {
  const TempFolder folder;
  const fs::path path = folder.file("p.toml.tuning");
  auto first = TuningFile::open(path, "a");
  REQUIRE(first);
  for (const char* digest : {"a", "b"}) {
    const auto second = TuningFile::open(path, digest);
    REQUIRE_FALSE(second);
    CHECK(second.error().message() == path.string() +
                                          ": is in use by another program; wait until that tuning has ended, or choose "
                                          "another --out");
    CHECK(fs::exists(path));
  }
  first->reset();
  CHECK(TuningFile::open(path, "b"));
}

TEST_CASE("a search for gains that was ended goes on to the same, solving the rest") {
  const TempFolder folder;
  const fs::path path = folder.file("p.toml.tuning");
  const Ground ground = testing::torus_ground(150);
  const Preset base = testing::paper_preset(0.02);
  const GainGrid grid = make_gain_grid(0.02);
  const std::string digest = tuning_digest(base, *ground.scene, *ground.motion);
  const GainTuning whole = tune_gains(ground.scene, base, *ground.motion, grid);
  std::size_t tried = 0;
  for (const std::size_t most : {std::size_t{70}, std::size_t{100'000}}) {  // ended after 70, then on to the end
    auto opened = TuningFile::open(path, digest);
    REQUIRE(opened);
    TuningFile& file = **opened;
    CHECK(file.found() == tried);
    const GainMemory memory{[&](const Gains& gains) { return file.score(gains); },
                            [&](const Gains& gains, const RunScore& score) {
                              ++tried;
                              file.keep(gains, score);
                            }};
    const auto keep_going = [&](std::size_t, std::size_t) { return tried < most; };
    const GainTuning tuned = tune_gains(ground.scene, base, *ground.motion, grid, keep_going, memory);
    CHECK(tuned.stopped == (most == 70));
    if (tuned.stopped) continue;
    CHECK(tuned.tried == whole.tried);
    CHECK(tried == whole.tried);
    REQUIRE(tuned.best.size() == whole.best.size());
    for (std::size_t i = 0; i < whole.best.size(); ++i) {
      CHECK(tuned.best[i].gains == whole.best[i].gains);
      CHECK(tuned.best[i].score.iterations == whole.best[i].score.iterations);
      CHECK(tuned.best[i].score.max_error_m == whole.best[i].score.max_error_m);
    }
  }
}

TEST_CASE("what decides a trial is in the digest of a tuning") {
  const FrontPlan plan = kept_plan();
  const std::vector<FrontGround> grounds = kept_grounds();
  const std::string digest = tuning_digest(plan, grounds);
  CHECK(tuning_digest(kept_plan(), kept_grounds()) == digest);
  const auto differs = [&](const std::function<void(FrontPlan&, std::vector<FrontGround>&)>& change) {
    FrontPlan other = plan;
    std::vector<FrontGround> on = grounds;
    change(other, on);
    return tuning_digest(other, on) != digest;
  };
  CHECK(differs([](FrontPlan& p, auto&) { p.seed = 2; }));
  CHECK(differs([](FrontPlan& p, auto&) { p.evaluations = 61; }));
  CHECK(differs([](FrontPlan& p, auto&) { p.race = false; }));
  CHECK(differs([](FrontPlan& p, auto&) { p.over_grounds = OverGrounds::mean; }));
  CHECK(differs([](FrontPlan& p, auto&) { p.base.force.stiffness_n_per_m += 1e-9; }));
  CHECK(differs([](FrontPlan& p, auto&) { p.ranges[0].to = 0.07; }));
  CHECK(differs([](FrontPlan& p, auto&) { p.ranges[1].logarithmic = false; }));
  CHECK(differs([](FrontPlan& p, auto&) { std::swap(p.objectives[0], p.objectives[1]); }));
  CHECK(differs([](FrontPlan& p, auto&) { p.constraints[0].most = 101.0; }));
  CHECK(differs([](FrontPlan& p, auto&) { p.starts.push_back(p.base); }));
  CHECK(differs([](auto&, auto& on) { on[0].ticks = 2500; }));
  CHECK(differs([](auto&, auto& on) { on[1].finger = Finger{}; }));
  CHECK(differs([](auto&, auto& on) {
    auto motion = *on[1].ground.motion;
    motion[7].finger.position.z += 1e-12;
    on[1].ground.motion = std::make_shared<const std::vector<TickInput>>(std::move(motion));
  }));
  CHECK_FALSE(differs([](FrontPlan& p, auto&) { p.threads = 7; }));
  CHECK_FALSE(differs([](auto&, auto& on) { on[0].name = "another"; }));
}

RacedTrial odd_trial() {
  RacedTrial out;
  out.trial.values = {0.1, 1e-300};
  out.trial.objectives = {std::numeric_limits<double>::infinity(), -0.0};
  out.trial.missed = 1.0 / 3.0;
  out.trial.ticks = 12;
  out.trial.dropped = true;
  out.trial.numbers.unconverged = std::numeric_limits<std::uint64_t>::max();
  out.trial.numbers.error_p99_m = 4.9e-324;
  out.trial.ground_numbers = {out.trial.numbers, CellNumbers{}};
  out.costs = {{{1.5, -std::numeric_limits<double>::infinity()}, {2.5, 3.5}}, {}};
  return out;
}

TEST_CASE("trials, gains and scales read back to the bit from their lines, and what is none of them is told") {
  TuningLine line;
  REQUIRE(parse_tuning_line(trial_line(7, odd_trial()), line));
  const auto& back = std::get<NumberedTrial>(line);
  CHECK(back.number == 7);
  CHECK(same(back.trial.trial, odd_trial().trial));
  CHECK(std::signbit(back.trial.trial.objectives[1]));
  CHECK(back.trial.costs == odd_trial().costs);
  REQUIRE(parse_tuning_line(scales_line({{1.1, 2.2}, {3.3, 4.4}}), line));
  CHECK(std::get<std::vector<TimeScale>>(line)[1].p99 == 4.4);
  for (const char* const none :
       {"", "[]", "{}", "{\"trial\":1}", "{\"gains\":[1,2]}", "{\"scales\":3}", "{\"trial\":-1"})
    CHECK_FALSE(parse_tuning_line(none, line));
}

TEST_CASE("a file of another tuning, one that is damaged and one in which nothing was tried") {
  const TempFolder folder;
  const fs::path path = folder.file("p.toml.tuning");
  const auto opened = [&](const std::string& digest) {
    const auto file = TuningFile::open(path, digest);
    return file ? std::string("opened") : file.error().message();
  };
  CHECK(opened("mine") == "opened");
  CHECK_FALSE(fs::exists(path));  // nothing was tried
  {
    auto file = *TuningFile::open(path, "mine");
    for (std::size_t i = 0; i < 3; ++i) file->keep(i, odd_trial());
    CHECK(file->status());
  }
  CHECK(opened("mine") == "opened");
  CHECK(contains(opened("other"), "keeps what another tuning tried"));
  CHECK(contains(opened("other"), path.string()));
  std::string text = read_text(path);
  text[text.find("\"dropped\"") + 3] = 'x';
  folder.write("p.toml.tuning", text);
  CHECK(contains(opened("mine"), "line 2 is damaged"));
  for (const char* const notes : {"notes of mine\nand more\n", "notes\n", "notes"}) {  // nobody's torn line
    folder.write("p.toml.tuning", notes);
    CHECK(contains(opened("mine"), "line 1 is damaged"));
    CHECK(read_text(path) == notes);
  }
  (*TuningFile::open(folder.file("new"), "mine"))->remove();
  CHECK_FALSE(fs::exists(folder.file("new")));
}

TEST_CASE("a full disk ends a search, keeps the trials that had room, and the search goes on with room") {
  const TempFolder folder;
  const fs::path path = folder.file("p.toml.tuning");
  FrontPlan plan = kept_plan();
  plan.evaluations = 30;
  const std::vector<FrontGround> grounds{{testing::torus_ground(600), 500}};
  const std::string digest = tuning_digest(plan, grounds);
  {
    const FullDisk full(10'000);
    auto file = TuningFile::open(path, digest);
    REQUIRE(file);
    const KeptSearch kept(plan, grounds, **file);
    CHECK(kept.found.stopped);
    CHECK(contains((*file)->status().error().message(), "make room"));
  }
  auto file = TuningFile::open(path, digest);
  REQUIRE(file);
  CHECK((*file)->found() > 0);
  const KeptSearch kept(plan, grounds, **file);
  CHECK(same(kept.found, search_front(plan, grounds)));
  CHECK(kept.anew == kept.found.trials.size() - (*file)->found());
}

}  // namespace
}  // namespace tangent::sweep
