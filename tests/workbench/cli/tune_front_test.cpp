#include "core/io/preset_file.h"
#include "tests/support/full_disk.h"
#include "tests/support/process.h"
#include "workbench/sweep/objective.h"

#include <sstream>

namespace tangent {
namespace {

using testing::contains;
using testing::ProcessResult;
using testing::read_text;
using testing::run_workbench;
using testing::TempFolder;

struct FrontFolder {
  TempFolder folder;
  std::string mesh = folder.file("torus.obj"), preset = folder.file("p.toml"), poses;
  FrontFolder() {
    REQUIRE(run_workbench({"make", "torus", "--out", mesh}).exit_code == 0);
    std::string text = "t_s,x_m,y_m,z_m\n";
    for (int i = 0; i < 400; ++i)  // across the ring and back, 1 to 2 mm deep
      text += std::to_string(1e-3 * i) + "," + std::to_string(0.02 + 1e-4 * (i % 200)) + ",0.001," +
              std::to_string(0.033 + 5e-6 * (i % 200)) + "\n";
    poses = folder.write("poses.csv", text);
  }
  ProcessResult tune(std::vector<std::string> options) const {
    options.insert(options.begin(), {"tune", mesh, "--poses", poses, "--out", preset, "--evaluations", "60"});
    return run_workbench(options);
  }
};

TEST_CASE("tune by two objectives writes a front of which no point beats another, and a preset that holds") {
  const FrontFolder t;
  const std::string csv = t.folder.file("front.csv");
  const ProcessResult tuned = t.tune({"--objective", "mean_iterations", "--objective", "error_p99_m", "--constraint",
                                      "unconverged = 0", "--range", "solver.gain_curvature_m=0..0.08", "--range",
                                      "solver.tolerance_m=1e-8..1e-4", "--front", csv});
  CHECK(tuned.exit_code == 0);
  CHECK(contains(tuned.out, "held-back poses"));
  CHECK(read_preset(t.preset)->about.note == "Of a front: mean_iterations error_p99_m, unconverged = 0");
  CHECK(run_workbench({"check", t.preset}).exit_code == 0);

  std::istringstream lines(read_text(csv));
  std::string line;
  REQUIRE(std::getline(lines, line));
  CHECK(line == "solver.gain_curvature_m,solver.tolerance_m,mean_iterations,error_p99_m");
  double last_iterations = 0.0, last_error = 1e300;
  int points = 0;
  while (std::getline(lines, line)) {
    double values[4];
    REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", values, values + 1, values + 2, values + 3) == 4);
    CHECK(values[2] > last_iterations);
    CHECK(values[3] < last_error);
    last_iterations = values[2];
    last_error = values[3];
    ++points;
  }
  CHECK(points >= 3);
}

TEST_CASE("tune by one objective keeps the simpler gains where its own are not clearly better") {
  const FrontFolder t;
  const ProcessResult tuned = t.tune({"--objective", "unconverged"});  // none of them fails here
  CHECK(tuned.exit_code == 0);
  CHECK(contains(tuned.out, "not clearly better"));
  const PresetFile file = *read_preset(t.preset);
  CHECK(file.preset.solver.gain_overall == 1.0);
  CHECK(file.preset.solver.gain_curvature_m == file.preset.finger.radius_m);
}

TEST_CASE("tune over several meshes, motions and fingers says each, and goes on without one that can't be read") {
  const FrontFolder t;
  const std::string ball = t.folder.file("ball.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", ball}).exit_code == 0);
  const ProcessResult tuned = t.tune({"--objective", "mean_iterations", "--also-mesh", ball, "--also-radius-mm", "8",
                                      "--constraint", "not_finite = 0", "--seed", "3"});
  CHECK_MESSAGE(tuned.exit_code == 0, tuned.err);
  CHECK(contains(tuned.out, "4 grounds, an objective is the worst of them"));
  CHECK(contains(tuned.err, "torus.obj, poses.csv, finger 8 mm: the finger touched nothing in 400 of 400 ticks"));
  CHECK(contains(tuned.out, "ball.obj, poses.csv, finger 8 mm: 400 ticks, 100 of them held back"));
  CHECK(contains(tuned.out, "Theory beside what was found"));
  CHECK(run_workbench({"check", t.preset}).exit_code == 0);
  const ProcessResult again = t.tune({"--objective", "mean_iterations", "--also-mesh", ball, "--also-radius-mm", "8",
                                      "--constraint", "not_finite = 0", "--seed", "3", "--threads", "1"});
  CHECK(again.out == tuned.out);

  const ProcessResult part = t.tune({"--objective", "mean_iterations", "--also-mesh", t.folder.file("none.obj"),
                                     "--poses", t.folder.file("none.csv"), "--over-grounds", "mean"});
  CHECK(part.exit_code == 1);
  CHECK(contains(part.err, "none.obj"));
  CHECK(contains(part.err, "none.csv"));
  CHECK(contains(part.err, "the others go on"));
  CHECK(std::filesystem::exists(t.preset));
}

TEST_CASE("tune by time measures it in turns, and keeps to a limit that it names with its unit") {
  const FrontFolder t;
  const ProcessResult tuned =
      t.tune({"--objective", "p99_time", "--objective", "error", "--constraint", "p99_time <= 10000 ms"});
  CHECK_MESSAGE(tuned.exit_code == 0, tuned.err);
  CHECK(contains(tuned.out, "measured in turns: mean "));
  CHECK(read_preset(t.preset)->about.note == "Of a front: p99_time error_p99_m, p99_time <= 1e+07 us");
  std::filesystem::remove(t.preset);
  const ProcessResult never = t.tune({"--objective", "error", "--constraint", "p99_time <= 1 ns"});
  CHECK(never.exit_code == 1);
  CHECK(contains(never.err, "p99_time <= 0.001 us (the nearest has "));
  CHECK(!std::filesystem::exists(t.preset));
}

TEST_CASE("tune replaces presets and fronts, and nothing else, and names a key that it would search for nothing") {
  const FrontFolder t;
  const std::string front = t.folder.file("f.csv");
  for (int again = 0; again < 2; ++again) {
    const ProcessResult tuned = t.tune({"--objective", "mean_iterations", "--front", front, "--method", "newton"});
    CHECK_MESSAGE(tuned.exit_code == 0, tuned.err);
    CHECK(contains(tuned.err, "solver.gain_curvature_m changes nothing under newton: paper alone reads it"));
  }
  const std::string notes = t.folder.write("notes.txt", "mine");
  for (const std::string& out : {notes, front}) {
    const std::string before = read_text(out);
    const ProcessResult refused = run_workbench({"tune", t.mesh, "--poses", t.poses, "--out", out});
    CHECK(refused.exit_code == 1);
    CHECK(contains(refused.err, "is not a preset, which alone is replaced; choose another name, or remove it"));
    CHECK(read_text(out) == before);
  }
}

TEST_CASE("tune by objectives refuses what can't be asked and says what can't be kept") {
  const FrontFolder t;
  struct Wrong {
    std::vector<std::string> options;
    int code;
    const char* said;
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {{"--objective", "speed"}, 2, "mean_iterations"},
           {{"--constraint", "unconverged = 0"}, 2, "--objective: is missing"},
           {{"--objective", "mean_iterations", "--constraint", "unconverged"}, 2, "NAME <= VALUE"},
           {{"--objective", "mean_iterations", "--constraint", "ticks <= 1", "--constraint", "ticks <= 2"}, 2, "twice"},
           {{"--objective", "mean_iterations", "--range", "solver.gain_overall=1,2"}, 2, "FROM..TO"},
           {{"--objective", "mean_iterations", "--evaluations", "1"}, 2, "--evaluations"},
           {{"--objective", "mean_iterations", "--range", "solver.gain_overall=1..1"}, 2, "FROM..TO"},
           {{"--objective", "mean_iterations", "--range", "solver.gain=1..2"}, 2, "names no key"},
           {{"--objective", "mean_iterations", "--constraint", "p99_time <= 20"}, 2, "20 us"},
           {{"--objective", "mean_iterations", "--also-radius-mm", "-1"}, 2, "is no radius"},
           {{"--objective", "mean_iterations", "--also-radius-mm", "8", "--range", "finger.radius_m=0.005..0.02"},
            2,
            "contradicts"},
           {{"--also-mesh", "none.obj"}, 2, "--objective: is missing"},
           {{}, 2, "--objective: is missing: --evaluations"},
           {{"--objective", "mean_iterations", "--poses", t.poses}, 2, "--poses: has one value twice"},
           {{"--objective", "mean_iterations", "--path", "strokes"}, 2, "excludes --path"},
           {{"--objective", "error", "--objective", "error_p99_m"}, 2, "error_p99_m is there twice"},
           {{"--objective", "mean_iterations", "--range", "solver.gain_overall=0..1", "--range",
             "solver.gain_overall=1..2"},
            2,
            "solver.gain_overall: is there twice"},
           {{"--objective", "mean_iterations", "--poses", "strokes:0mm"}, 2, "strokes:0.5mm; allowed: 0.001 to 20 mm"},
           {{"--objective", "mean_iterations", "--front", t.folder.write("n.csv", "mine")},
            1,
            "is not the table of a front"},
           {{"--objective", "mean_iterations", "--constraint", "mean_iterations <= 0.5"}, 1, "mean_iterations <= 0.5"},
       }) {
    const ProcessResult result = t.tune(wrong.options);
    CHECK(result.exit_code == wrong.code);
    CHECK_MESSAGE(contains(result.err, wrong.said), result.err);
    CHECK(!std::filesystem::exists(t.preset));
  }
}

TEST_CASE("a tuning that could not go on keeps what it tried, and the same command goes on to the same result") {
  const FrontFolder t;
  const std::string front = t.folder.file("front.csv"), kept = t.preset + ".tuning";
  const std::vector<std::string> options{"--objective", "mean_iterations", "--objective", "error", "--front", front};
  REQUIRE(t.tune(options).exit_code == 0);
  const Preset whole = read_preset(t.preset)->preset;
  const std::string points = read_text(front);
  CHECK(!std::filesystem::exists(kept));  // it has ended
  std::filesystem::remove(t.preset);
  ProcessResult ended;
  {
    const testing::FullDisk full(4000);  // for some of its trials
    ended = t.tune(options);
  }
  CHECK(ended.exit_code == 1);
  CHECK(contains(ended.err, kept + ": can't be written"));
  CHECK(!std::filesystem::exists(t.preset));
  const ProcessResult again = t.tune(options);
  CHECK_MESSAGE(again.exit_code == 0, again.err);
  CHECK(contains(again.err, "goes on from " + kept + ", which keeps "));
  CHECK(read_preset(t.preset)->preset == whole);
  CHECK(read_text(front) == points);
  CHECK(!std::filesystem::exists(kept));
}

TEST_CASE("a tuning does not go on with what another tried") {
  const FrontFolder t;
  {
    const testing::FullDisk full(3000);
    CHECK(t.tune({"--objective", "mean_iterations"}).exit_code == 1);
  }
  const std::string kept = t.preset + ".tuning", before = read_text(kept);
  const ProcessResult other = t.tune({"--objective", "error"});
  CHECK(other.exit_code == 1);
  CHECK(contains(other.err, kept + ": keeps what another tuning tried"));
  CHECK(read_text(kept) == before);
  CHECK(t.tune({"--objective", "mean_iterations"}).exit_code == 0);
}

}  // namespace
}  // namespace tangent
