#include "tests/support/meshes.h"
#include "tests/support/process.h"
#include "workbench/recording/database.h"

#include <chrono>
#include <thread>

#include <sys/stat.h>

namespace tangent {
namespace {

using testing::contains;
using testing::Process;
using testing::ProcessResult;
using testing::run_workbench;
using testing::TempFolder;

struct Sweep {
  TempFolder folder;

  Sweep() {
    REQUIRE(run_workbench({"make", "cube", "--out", folder.file("cube.obj")}).exit_code == 0);
    folder.write(
        "plan.toml",
        "[plan]\nmeshes = [\"cube.obj\"]\nposes = [\"around\"]\nmethods = [\"paper\", \"robust\"]\nticks = 400\n"
        "[ranges]\n\"solver.gain_curvature_m\" = { from = 0.001, to = 0.1, count = 20 }\n");
  }
  ProcessResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "sweep");
    return run_workbench(std::move(arguments));
  }
  std::string file(const char* name) const { return folder.file(name); }
  /// All rows of table cells.
  std::vector<std::string> rows(const char* name) const {
    Result<Database> database = Database::open(file(name));
    REQUIRE_MESSAGE(database, database.error().message());
    Result<Statement> statement = database->prepare("SELECT * FROM cells ORDER BY cell");
    REQUIRE(statement);
    std::vector<std::string> out;
    while (*statement->step()) {
      std::string& row = out.emplace_back();
      for (int c = 0; c < 34; ++c) row += statement->text(c) + "|";
    }
    return out;
  }
};

TEST_CASE("sweep: a motion that touches nothing is remarked on once, by its mesh and its name") {
  const Sweep sweep;
  const std::string far = sweep.folder.write("far.csv", "t_s,x_m,y_m,z_m\n0,59,0,0\n0.001,59,0,1\n");
  const ProcessResult done =
      sweep.run({sweep.file("cube.obj"), "--poses", far, "--poses", "around", "--ticks", "50", "--range",
                 "solver.gain_curvature_m=0.01,0.02", "--out", sweep.file("out.sqlite")});
  CHECK(done.exit_code == 0);
  const std::string note = "cube.obj, " + far + ": the finger touched nothing in 2 of 2 ticks";
  CHECK(contains(done.err, note));
  CHECK(done.err.find("touched nothing") == done.err.rfind("touched nothing"));
}

TEST_CASE("sweep: shards that are killed and run again give what one process gives") {
  const Sweep sweep;
  REQUIRE(sweep.run({"--plan", sweep.file("plan.toml"), "--out", sweep.file("one.sqlite")}).exit_code == 0);
  const auto rows = sweep.rows("one.sqlite");
  CHECK(rows.size() == 40);

  REQUIRE(sweep.run({"plan", sweep.file("plan.toml"), "--out", sweep.file("dir"), "--shards", "2"}).exit_code == 0);
  for (const std::string shard : {"0", "1"}) {
    for (int ms = 5; ms <= 80; ms *= 2) {  // killed somewhere: before the file, in it, or not at all
      const Process process({"sweep", "run", sweep.file("dir"), "--shard", shard, "--threads", "1"});
      std::this_thread::sleep_for(std::chrono::milliseconds(ms));
      process.interrupt(SIGKILL);
      static_cast<void>(process.wait());
    }
    CHECK(sweep.run({"run", sweep.file("dir"), "--shard", shard}).exit_code == 0);
  }
  REQUIRE(sweep.run({"merge", sweep.file("dir"), "--out", sweep.file("merged.sqlite")}).exit_code == 0);
  CHECK(sweep.rows("merged.sqlite") == rows);
}

TEST_CASE("sweep: one that is killed goes on from what is done") {
  const Sweep sweep;
  const std::vector<std::string> command{"sweep", "--plan", sweep.file("plan.toml"), "--out",
                                         sweep.file("killed.sqlite")};
  for (int ms = 20; ms <= 80; ms *= 2) {
    const Process process(command);
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    process.interrupt(SIGKILL);
    static_cast<void>(process.wait());
  }
  REQUIRE(run_workbench(command).exit_code == 0);
  REQUIRE(sweep.run({"--plan", sweep.file("plan.toml"), "--out", sweep.file("one.sqlite")}).exit_code == 0);
  CHECK(sweep.rows("killed.sqlite") == sweep.rows("one.sqlite"));
}

TEST_CASE("sweep: options say the same as a plan") {
  const Sweep sweep;
  REQUIRE(sweep.run({"--plan", sweep.file("plan.toml"), "--out", sweep.file("plan.sqlite")}).exit_code == 0);
  REQUIRE(sweep
              .run({sweep.file("cube.obj"), "--poses", "around", "--methods", "paper,robust", "--ticks", "400",
                    "--range", "solver.gain_curvature_m=0.001..0.1:20", "--out", sweep.file("options.sqlite")})
              .exit_code == 0);
  CHECK(sweep.rows("options.sqlite") == sweep.rows("plan.sqlite"));
}

TEST_CASE("sweep: a mesh that can't be read is named, and the others are solved") {
  const Sweep sweep;
  const auto result = sweep.run({sweep.file("cube.obj"), sweep.file("none.obj"), "--poses", "around", "--ticks", "50",
                                 "--out", sweep.file("a.sqlite")});
  CHECK(result.exit_code == 1);
  CHECK(contains(result.err, "none.obj"));
  CHECK(contains(result.out, "2 of 2 cells"));
  CHECK(sweep.rows("a.sqlite").size() == 2);
}

TEST_CASE("sweep: every mesh and motion that can't be read is named, and what to do once") {
  const Sweep sweep;
  const auto result = sweep.run({sweep.file("cube.obj"), sweep.file("none.obj"), sweep.file("no.obj"), "--poses",
                                 "around", sweep.file("no.csv"), "--ticks", "50", "--out", sweep.file("a.sqlite")});
  CHECK(result.exit_code == 1);
  CHECK(contains(result.err, "a.sqlite: 2 cells have no numbers, the first, cell 2: " + sweep.file("none.obj") + ": "));
  CHECK(contains(result.err, "a.sqlite: 2 cells have no numbers, the first, cell 4: " + sweep.file("no.obj") + ": "));
  CHECK(contains(result.err, "a.sqlite: 1 cell has no numbers, the first, cell 1: " + sweep.file("no.csv") + ": "));
  CHECK(contains(result.err, "a.sqlite: 5 cells have no numbers, the others have; mend what they lack, then the same"));
}

TEST_CASE("sweep: cells without numbers fail the next run over them, too") {
  const Sweep sweep;
  const std::vector<std::string> command{
      sweep.file("cube.obj"), sweep.file("none.obj"), "--poses", "around", "--ticks", "50", "--out",
      sweep.file("a.sqlite")};
  for (const char* const there : {"", "(2 were there)"}) {
    const auto result = sweep.run(command);
    CHECK(result.exit_code == 1);
    CHECK(contains(result.out, there));
    CHECK(contains(result.err, "a.sqlite: 1 cell has no numbers, the others have; the first, cell 1: "));
    CHECK(contains(result.err, "none.obj"));
    CHECK(contains(result.err, "then the same command with --again failed solves them"));
  }
}

TEST_CASE(
    "sweep: how many were solved and how many failed are two numbers, and the failed are solved when asked again") {
  const Sweep sweep;
  std::vector<std::string> command{
      sweep.file("cube.obj"), sweep.file("late.obj"), "--poses", "around", "--ticks", "50", "--out",
      sweep.file("a.sqlite")};
  const auto first = sweep.run(command);
  CHECK(first.exit_code == 1);
  CHECK(contains(first.out, "2 of 2 cells in "));
  CHECK(contains(first.out, "; 1 solved in "));
  CHECK(contains(first.out, ", 1 failed\n"));
  std::filesystem::copy(sweep.file("cube.obj"), sweep.file("late.obj"));
  const auto refused = sweep.run(command);
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.err, "add --again failed"));
  command.insert(command.end(), {"--again", "failed"});
  const auto mended = sweep.run(command);
  CHECK_MESSAGE(mended.exit_code == 0, mended.err);
  CHECK(contains(mended.out, "(1 were there); 1 solved in "));
  CHECK(!contains(mended.out, "failed"));
  CHECK(sweep.run({"--again", "solved"}).exit_code == 2);
}

TEST_CASE("sweep: a method beside a list of methods is wrong usage") {
  const Sweep sweep;
  const auto result = sweep.run({sweep.file("cube.obj"), "--poses", "around", "--methods", "paper,robust", "--method",
                                 "newton", "--out", sweep.file("a.sqlite")});
  CHECK(result.exit_code == 2);
  CHECK(contains(result.err, "--method: contradicts --methods"));
}

TEST_CASE("sweep: a key that no method reads is said, and a shard that is none is wrong usage") {
  const Sweep sweep;
  const auto swept = sweep.run({sweep.file("cube.obj"), "--poses", "around", "--ticks", "20", "--methods", "robust",
                                "--range", "solver.gain_overall=0.5,1", "--out", sweep.file("a.sqlite")});
  CHECK(swept.exit_code == 0);
  CHECK(contains(swept.err, "solver.gain_overall changes nothing under robust: paper alone reads it"));
  REQUIRE(sweep.run({"plan", sweep.file("plan.toml"), "--out", sweep.file("dir"), "--shards", "3"}).exit_code == 0);
  const auto none = sweep.run({"run", sweep.file("dir"), "--shard", "3"});
  CHECK(none.exit_code == 2);
  CHECK(contains(none.err, "--shard: 3 is no shard of 3; allowed: 0 to 2"));
}

TEST_CASE("sweep: a pipe without a writer is refused where it would be read again, and elsewhere ends by Ctrl-C") {
  const Sweep sweep;
  const std::string pipe = sweep.file("pipe.csv"), cube = sweep.file("cube.obj");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const auto swept = sweep.run({cube, "--poses", pipe, "--out", sweep.file("a.sqlite")});
  CHECK(swept.exit_code == 1);
  CHECK(contains(swept.err, "pipe.csv: is no file that can be read again"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"tune", cube, "--poses", pipe, "--out", sweep.file("p.toml")},
        {"experiment", pipe, "--participant", "P1", "--out", sweep.file("e"), "--simulated", "known"},
        {"bench", "--mesh", cube, "--poses", pipe},
        {"check", pipe}}) {
    const Process process(command);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    process.interrupt();
    CHECK_MESSAGE(process.wait().exit_code != 0, command.front());  // and it ends
  }
}

TEST_CASE("sweep: a dry run counts, and a million cells want a yes") {
  const Sweep sweep;
  const std::vector<std::string> many{sweep.file("cube.obj"),
                                      "--poses",
                                      "around",
                                      "--range",
                                      "solver.gain_overall=0..2:1000",
                                      "--range",
                                      "solver.gain_curvature_m=0..1:1000"};
  auto dry = many;
  dry.push_back("--dry-run");
  const auto counted = sweep.run(dry);
  CHECK(counted.exit_code == 0);
  CHECK(contains(counted.out, "1000000 cells: 1 mesh x 1 motion x 1 finger x 1000000 presets"));
  auto unasked = many;
  unasked.insert(unasked.end(), {"--out", sweep.file("a.sqlite")});
  const auto refused = sweep.run(unasked);
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.err, "--yes"));
  CHECK(!std::filesystem::exists(sweep.file("a.sqlite")));
}

TEST_CASE("sweep: wrong usage is told from work that failed") {
  const Sweep sweep;
  const std::string cube = sweep.file("cube.obj"), out = sweep.file("a.sqlite");
  struct Wrong {
    std::vector<std::string> arguments;
    int code;
    const char* said;
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {{"--poses", "around", "--out", out}, 2, "MESH"},
           {{cube, "--poses", "around"}, 2, "--out"},
           {{cube, "--poses", "around", "--out", out, "--range", "solver.gain=1"}, 2, "names no key"},
           {{cube, "--poses", "around", "--out", out, "--range", "solver.gain_overall=1..2:x"}, 2, "count"},
           {{cube, "--poses", "around", "--out", out, "--range", "solver.gain_overall=99"}, 2, "allowed: 0 to 10"},
           {{cube, "--poses", "around", "--out", out, "--range", "solver.gain_overall="}, 2, "lacks a value"},
           {{cube, "--poses", "around", "--out", out, "--range", "solver.gain_overall=1..:3"}, 2, "lacks a value"},
           {{cube, "--poses", "around", "--out", out, "--threads", "0"}, 2, "--threads"},
           {{cube, "--out", out}, 2, "--poses: no motion"},
           {{cube, "--poses", "around", "--out", out, "--methods", "newtn"}, 2, "is no method"},
           {{cube, "--poses", "around", "--out", out, "--methods", "paper,paper"}, 2, "paper is there twice"},
           {{cube, "--poses", "around", "around", "--out", out}, 2, "around is there twice"},
           {{cube, "--poses", "around:0mm", "--out", out}, 2, "around:0.5mm; allowed: 0.001 to 20 mm"},
           {{cube, "--poses", "around", "--out", out, "--sampling", "sobol"},
            2,
            "--samples: sampling = \"sobol\" needs"},
           {{cube, "--poses", "around", "--out", out, "--range", "solver.gain_overall=1,2", "--range",
             "solver.gain_overall=0..1:3"},
            2,
            "solver.gain_overall: is there twice"},
           {{cube, "--poses", "around", "--out", cube}, 2, "--out: names the same file as MESH"},
           {{"--plan", sweep.file("plan.toml"), "--out", out, "--ticks", "20"}, 2, "leave out --sampling, --samples"},
           {{"--plan", sweep.file("plan.toml"), "--out", out, "--gain-overall", "1"}, 2, "leave out --preset"},
           {{cube, "--plan", sweep.file("plan.toml"), "--out", out}, 2, "--plan"},
           {{cube, "--poses", "around", "--out", sweep.folder.write("notes.txt", "mine")}, 1, "no sweep's results"},
           {{"--plan", sweep.file("none.toml"), "--out", out}, 1, "none.toml"},
           {{"run", sweep.folder.path().string()}, 1, "plan.json"},
           {{"merge", sweep.file("none"), "--out", out}, 1, "plan.json"},
           {{"plan", sweep.file("plan.toml"), "--out", sweep.file("dir"), "--shards", "41"}, 2, "--shards"},
       }) {
    const auto result = sweep.run(wrong.arguments);
    CHECK(result.exit_code == wrong.code);
    CHECK_MESSAGE(contains(result.err, wrong.said), result.err);
    CHECK(!std::filesystem::exists(out));
  }
}

}  // namespace
}  // namespace tangent
