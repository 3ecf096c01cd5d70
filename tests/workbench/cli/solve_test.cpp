// workbench solve, run as a process: its files, its options, and errors for bad ones.
#include "core/io/ticks_file.h"
#include "tests/support/approx.h"
#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <thread>

using namespace tangent::testing;
using tangent::test::approx;

namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows read_csv(const std::string& path) {
  Rows rows;
  std::istringstream in(read_text(path));
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// A folder with a sphere of 40 mm and a finger of 20 mm that slides over it, 1 mm deep.
struct SolveScene {
  TempFolder folder;
  std::string mesh = folder.file("sphere.obj");
  std::string poses;

  explicit SolveScene(int count = 200) {
    REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
    std::ostringstream text;
    text.precision(17);
    text << "t_s,x_m,y_m,z_m\n";
    for (int i = 0; i < count; ++i) {
      const double angle = 0.001 / 0.6 * i;
      text << 0.001 * i << ',' << 0.059 * std::cos(angle) << ',' << 0.059 * std::sin(angle) << ",0.003\n";
    }
    poses = folder.write("poses.csv", text.str());
  }

  ProcessResult solve(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"solve", mesh, "--poses", poses, "--out", folder.file("ticks.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_workbench(arguments);
  }
  Rows ticks() const { return read_csv(folder.file("ticks.csv")); }
  nlohmann::json summary() const { return nlohmann::json::parse(read_text(folder.file("summary.json"))); }
};

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

std::size_t column(const std::string& name) {
  std::istringstream in{std::string(tangent::kTicksHeader)};
  std::size_t index = 0;
  for (std::string field; std::getline(in, field, ','); ++index) {
    if (field == name) return index;
  }
  FAIL("no column " << name);
  return 0;
}

}  // namespace

TEST_CASE("every pose becomes a line, in order, converged, with the promised columns") {
  const SolveScene scene;
  const ProcessResult result = scene.solve();
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK(contains(result.out, "200 ticks on sphere.obj (320 triangles), sphere finger of 20 mm"));
  const std::string text = read_text(scene.folder.file("ticks.csv"));
  CHECK(text.starts_with(std::string(tangent::kTicksHeader) + "\n"));
  CHECK_FALSE(contains(text, "nan"));
  CHECK_FALSE(contains(text, "inf"));
  const Rows rows = scene.ticks();
  REQUIRE(rows.size() == 201);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    REQUIRE(rows[i].size() == 27);
    CHECK(rows[i][0] == std::to_string(i - 1));
    CHECK(rows[i][column("status")] == "face");
    CHECK(rows[i][column("event")] == (i == 1 ? "first" : "none"));
    CHECK(number(rows[i][column("error_m")]) < 1e-6);
    CHECK(number(rows[i][column("penetration_m")]) == approx(1e-3).epsilon(0.1));
    CHECK(number(rows[i][column("force_x_n")]) > 0.0);
  }
  CHECK(scene.folder.entry_count() == 4);  // mesh, poses, ticks and what their columns are: nothing else left behind
}

TEST_CASE("the summary agrees with the ticks") {
  const SolveScene scene;
  REQUIRE(scene.solve({"--summary", scene.folder.file("summary.json")}).exit_code == 0);
  const nlohmann::json summary = scene.summary();
  const Rows rows = scene.ticks();
  double iterations = 0.0, error = 0.0, slowest = 0.0;
  std::map<std::string, int> statuses;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    iterations += number(rows[i][column("iterations")]);
    error = std::max(error, number(rows[i][column("error_m")]));
    slowest = std::max(slowest, number(rows[i][column("solve_ns")]));
    ++statuses[rows[i][column("status")]];
  }
  CHECK(summary["ticks"] == 200);
  CHECK(summary["interrupted"] == false);
  CHECK(summary["statuses"]["face"] == statuses["face"]);
  CHECK(summary["events"]["first"] == 1);
  CHECK(summary["iterations"]["all"]["mean"].get<double>() == approx(iterations / 200.0).epsilon(1e-12));
  CHECK(summary["iterations"]["event_free"]["count"] == 199);
  CHECK(summary["max_error_m"] == error);
  CHECK(summary["solve_ns"]["max"] == slowest);
  CHECK(summary["mesh"]["triangles"] == 320);
}

TEST_CASE("a run by facets holds less than one by a smooth method, and C1 reports the facets' contact") {
  const SolveScene scene(50);
  const auto run = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--summary", scene.folder.file("summary.json")});
    REQUIRE(scene.solve(options).exit_code == 0);
    return scene.ticks();
  };
  run({"--method", "robust"});
  const double smooth = scene.summary()["scene"]["memory_bytes"].get<double>();
  const Rows facet = run({"--method", "facet"});
  CHECK(scene.summary()["scene"]["memory_bytes"].get<double>() < smooth);
  const Rows c1 = run({"--method", "robust", "--condition", "C1"});
  CHECK(scene.summary()["scene"]["memory_bytes"].get<double>() < smooth);
  for (std::size_t i = 1; i < c1.size(); ++i) {
    for (const char* name :
         {"triangle", "normal_x", "normal_y", "normal_z", "penetration_m", "force_x_n", "iterations"})
      CHECK(c1[i][column(name)] == facet[i][column(name)]);
  }
}

TEST_CASE("the trace has the planes that the ticks counted") {
  const SolveScene scene(20);
  REQUIRE(scene.solve({"--iterations", scene.folder.file("iterations.csv")}).exit_code == 0);
  const Rows trace = read_csv(scene.folder.file("iterations.csv"));
  const Rows ticks = scene.ticks();
  REQUIRE(trace.size() > 20);
  CHECK(trace[0].front() == "tick");
  CHECK(trace[1].front() == "0");
  CHECK(trace.back().front() == "19");
  std::string last_stop;
  for (const auto& row : trace) {
    if (row.front() == "19") last_stop = row[3];
  }
  CHECK(last_stop == "converged");
  // The same ticks, traced or not.
  const SolveScene untraced(20);
  REQUIRE(untraced.solve().exit_code == 0);
  Rows plain = untraced.ticks();
  REQUIRE(plain.size() == ticks.size());
  for (std::size_t i = 1; i < plain.size(); ++i) {
    plain[i][column("solve_ns")] = ticks[i][column("solve_ns")];
    CHECK(plain[i] == ticks[i]);
  }
}

TEST_CASE("options override the preset file, which overrides the built-in values") {
  const SolveScene scene(20);
  const std::string preset = scene.folder.write("p.toml",
                                                "[solver]\nmethod = \"newton\"\ntolerance_m = 5e-7\n[finger]\nshape = "
                                                "\"point\"\n[force]\nstiffness_n_per_m = 100\n");
  REQUIRE(scene
              .solve({"--preset", preset, "--tolerance-um", "0.1", "--finger-radius-mm", "12.5", "--condition", "C1",
                      "--summary", scene.folder.file("summary.json")})
              .exit_code == 0);
  const nlohmann::json values = scene.summary()["preset"]["values"];
  CHECK(values["solver"]["method"] == "newton");
  CHECK(values["solver"]["tolerance_m"].get<double>() == approx(1e-7).epsilon(1e-12));
  CHECK(values["finger"]["shape"] == "sphere");
  CHECK(values["finger"]["radius_m"] == 0.0125);
  CHECK(values["force"]["stiffness_n_per_m"] == 100.0);
  CHECK(values["force"]["source"] == "facet");
  CHECK(values["display"]["source"] == "held");
  CHECK(values["solver"]["max_iterations"] == 50);
  for (const auto& row : scene.ticks()) {
    if (row.front() != "tick") CHECK(number(row[column("cld_m")]) == 0.0);
  }
}

TEST_CASE("a radius of zero is a point finger") {
  const SolveScene scene(20);
  REQUIRE(scene.solve({"--finger-radius-mm", "0", "--summary", scene.folder.file("summary.json")}).exit_code == 0);
  CHECK(scene.summary()["preset"]["values"]["finger"]["shape"] == "point");
  CHECK(scene.ticks()[1][column("status")] == "free");
}

TEST_CASE("bad files are named, leave with 1 and leave nothing behind") {
  const SolveScene scene(5);
  const auto check_failed = [&](const ProcessResult& result, const std::string& message) {
    CHECK(result.exit_code == 1);
    CAPTURE(result.err);
    CHECK(contains(result.err, message));
    CHECK_FALSE(std::filesystem::exists(scene.folder.file("ticks.csv")));
  };
  const auto with_preset = [&](const std::string& text) {
    return scene.solve({"--preset", scene.folder.write("bad.toml", text)});
  };
  const auto with_poses = [&](const std::string& text) {
    return run_workbench(
        {"solve", scene.mesh, "--poses", scene.folder.write("bad.csv", text), "--out", scene.folder.file("ticks.csv")});
  };
  SUBCASE("presets") {
    check_failed(with_preset("[solver]\ngain = 1\n"), "bad.toml:2 solver.gain: unknown key");
    check_failed(with_preset("[solver]\ngain_overall = \"big\"\n"),
                 "bad.toml:2 solver.gain_overall: is text; allowed: 0 to 10");
    check_failed(with_preset("[solver]\ngain_overall = 11\n"),
                 "bad.toml:2 solver.gain_overall: 11 is out of range; allowed: 0 to 10");
    check_failed(with_preset("[solver]\ngain_overall = nan\n"), "is out of range");
    check_failed(with_preset("[solver\n"), "bad.toml:1");
    check_failed(scene.solve({"--preset", scene.folder.file("none.toml")}), "none.toml: can't be opened");
  }
  SUBCASE("poses") {
    check_failed(with_poses("t_s,x_m,y_m,z_m\n0,0,0,0\n0.001,nan,0,0\n"), "bad.csv:3: x_m is \"nan\"");
    check_failed(with_poses("t_s,x_m,y_m\n0,0,0\n"), "bad.csv:1: the header is");
    check_failed(with_poses("t_s,x_m,y_m,z_m\n0,0,0\n"), "bad.csv:2: only 3 columns");
    check_failed(with_poses(""), "bad.csv: the file is empty");
    check_failed(with_poses("t_s,x_m,y_m,z_m\n"), "bad.csv: no poses");
    check_failed(with_poses("t_s,x_m,y_m,z_m\n0,0,0,0\n1e-7,0,0,0\n"), "bad.csv:3: t_s increases by only 1e-07");
    check_failed(run_workbench({"solve", scene.mesh, "--poses", "/dev/zero", "--out", scene.folder.file("ticks.csv")}),
                 "/dev/zero:1: holds a zero byte");
  }
  SUBCASE("meshes") {
    check_failed(run_workbench({"solve", scene.folder.file("none.obj"), "--poses", scene.poses, "--out",
                                scene.folder.file("ticks.csv")}),
                 "none.obj");
    check_failed(run_workbench({"solve", scene.folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
                                "--poses", scene.poses, "--out", scene.folder.file("ticks.csv")}),
                 "bad.obj:4");
  }
}

TEST_CASE("a finger a thousand times larger than the mesh is solved for and remarked on") {
  const SolveScene scene(50);
  const ProcessResult result =
      scene.solve({"--fit-mm", "1", "--finger-radius-mm", "1000", "--summary", scene.folder.file("summary.json")});
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "note: the finger reaches 1000 mm, 1000 times the mesh's longest side of 1 mm"));
  REQUIRE(scene.summary()["mesh"]["notes"].size() == 1);
  CHECK(contains(scene.summary()["mesh"]["notes"][0].get<std::string>(), "check --unit or --fit-mm"));
  CHECK(scene.summary()["ticks"] == 50);
}

TEST_CASE("one of a thing is said in the singular, and what no tick is counts as none, not as 0") {
  const SolveScene scene(1);
  const std::string plate = scene.folder.write("plate.obj", "v -40 -40 0\nv 40 -40 0\nv 0 40 0\nf 1 2 3\n");
  const std::string pose = scene.folder.write("one.csv", "t_s,x_m,y_m,z_m\n0,0,0,0.019\n");
  const ProcessResult result = run_workbench({"solve", plate, "--poses", pose, "--out", scene.folder.file("ticks.csv"),
                                              "--explain", "--method", "facet", "--many-planes", "0"});
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "1 tick on plate.obj (1 triangle)"));
  CHECK_FALSE(contains(result.out, " 1 iterations"));
  const ProcessResult first =
      run_workbench({"solve", plate, "--poses", pose, "--out", scene.folder.file("ticks.csv"), "--explain"});
  CHECK(contains(first.out, "event first, "));
  CHECK_FALSE(contains(first.out, " 1 iterations"));
  CHECK(contains(first.out, "no event  none: there is no such tick"));
}

TEST_CASE("a text that is no mesh is named by its first word and line") {
  const SolveScene scene(1);
  const auto solve = [&](const std::string& text) {
    return run_workbench({"solve", scene.folder.write("text.obj", text), "--poses", scene.poses, "--out",
                          scene.folder.file("ticks.csv")});
  };
  const ProcessResult prose = solve("# a note\n\nhello world\n");
  CHECK(prose.exit_code == 1);
  CHECK(contains(prose.err, "text.obj:3: \"hello\" is not an OBJ keyword, and the file has no faces"));
  CHECK(contains(solve("o part\nv 0 0 0\n").err, "the file has no faces (1 vertex)"));
}

TEST_CASE("a mesh a thousand times larger than the finger is solved for and remarked on") {
  const SolveScene scene(5);
  const ProcessResult result = scene.solve({"--unit", "m"});
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "note: the mesh is 8e+04 mm long, 4000 times the finger's reach of 20 mm: check --unit"));
}

TEST_CASE("poses that touch nothing are solved for and remarked on, with how near they came and what to check") {
  const SolveScene scene(50);
  std::string text = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 50; ++i) text += std::to_string(0.001 * i) + ",59," + std::to_string(0.1 * i) + ",3\n";  // in mm
  const ProcessResult result =
      run_workbench({"solve", scene.mesh, "--poses", scene.folder.write("mm.csv", text), "--out",
                     scene.folder.file("ticks.csv"), "--summary", scene.folder.file("summary.json")});
  CHECK(result.exit_code == 0);
  CHECK(
      contains(result.err, "workbench solve: the finger touched nothing in 50 of 50 ticks; the nearest it came was 5"));
  CHECK(contains(result.err, " m: check the units, metres of the poses and --unit of the mesh"));
  REQUIRE(scene.summary()["mesh"]["notes"].size() == 1);
  CHECK(contains(scene.summary()["mesh"]["notes"][0].get<std::string>(), "touched nothing"));
  // By a method that does not converge so far off, too, and not of a motion that touches while no tick converges.
  const ProcessResult paper = run_workbench({"solve", scene.mesh, "--poses", scene.folder.file("mm.csv"), "--method",
                                             "paper", "--out", scene.folder.file("ticks.csv")});
  CHECK(contains(paper.err, "touched nothing in 50 of 50 ticks"));
  const ProcessResult lost = scene.solve({"--method", "paper", "--max-iterations", "1", "--gain-overall", "0.1"});
  CHECK_FALSE(contains(lost.err, "touched nothing"));
}

TEST_CASE("an output that can't be written is named before any work and nothing is left") {
  const SolveScene scene(5);
  const std::size_t before = scene.folder.entry_count();
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"solve", scene.mesh, "--poses", scene.poses, "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_workbench(arguments);
  };
  const std::string missing = scene.folder.file("no/such/folder/f");
  const ProcessResult ticks = run(missing, {});
  CHECK(ticks.exit_code == 1);
  CHECK(contains(ticks.err, missing + ": "));
  CHECK(contains(ticks.err, "No such file or directory"));
  const ProcessResult folder = run(scene.folder.path().string(), {});
  CHECK(folder.exit_code == 1);
  CHECK(contains(folder.err, scene.folder.path().string() + ": is a directory"));
  const ProcessResult full = run("/dev/full", {});
  CHECK(full.exit_code == 1);
  CHECK(contains(full.err, "/dev/full: "));
  CHECK(contains(full.err, "No space left on device"));
  const ProcessResult summary = run(scene.folder.file("ticks.csv"), {"--summary", missing});
  CHECK(summary.exit_code == 1);
  CHECK(contains(summary.err, missing));
  CHECK(scene.folder.entry_count() == before);
}

namespace {

/// Whether a temporary file lies in `folder`, of at least `bytes`.
bool half_written(const TempFolder& folder, std::uintmax_t bytes = 0) {
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (!contains(entry.path().filename().string(), ".tmp-")) continue;
    std::error_code gone;
    const std::uintmax_t size = std::filesystem::file_size(entry, gone);
    if (!gone && size >= bytes) return true;
  }
  return false;
}

/// Waits until a command writes its ticks to `folder`; false after two minutes. An empty temporary file is not
/// enough: with one the command tries beforehand whether it may write there, and takes it away again.
bool comes_to_write(const TempFolder& folder) {
  for (int i = 0; i < 12000; ++i) {
    if (half_written(folder, 100000)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

void interrupt_a_run(int signal) {
  // The paper's iteration without gains runs to its limit on a finger far bigger than the torus' bore: slow on purpose.
  const TempFolder folder;
  const std::string mesh = folder.file("torus.obj"), ticks = folder.file("ticks.csv");
  REQUIRE(run_workbench({"make", "torus", "--out", mesh}).exit_code == 0);
  std::string text = "t_s,x_m,y_m,z_m\n";
  constexpr int kPoses = 30000;
  for (int i = 0; i < kPoses; ++i) {
    text += std::to_string(i) + "e-3,0.0" + std::to_string(1 + i % 7) + ",0.01,0.02\n";
  }
  const std::string poses = folder.write("poses.csv", text);
  const Process process({"solve", mesh, "--poses", poses, "--out", ticks, "--summary", folder.file("summary.json"),
                         "--method", "paper", "--gain-curvature-m", "0", "--max-iterations", "1000", "--tolerance-um",
                         "1e-6"});
  REQUIRE(comes_to_write(folder));
  process.interrupt(signal);
  const ProcessResult result = process.wait();
  CAPTURE(result.err);
  CHECK(result.exit_code == 1);
  CHECK(contains(result.err, "interrupted after "));
  CHECK(contains(result.err, " of 30000 poses; " + ticks + " holds those"));
  const Rows rows = read_csv(ticks);
  REQUIRE(rows.size() > 1);
  CHECK(rows.size() < kPoses);
  CHECK(rows.back().size() == 27);
  const auto summary = nlohmann::json::parse(read_text(folder.file("summary.json")));
  CHECK(summary["interrupted"] == true);
  CHECK(summary["ticks"] == rows.size() - 1);
  CHECK(folder.entry_count() == 5);  // mesh, poses, ticks with what their columns are, summary
}

}  // namespace

TEST_CASE("Ctrl-C, a closed terminal and a polite kill keep the ticks that are done, and say so") {
  for (const int signal : {SIGINT, SIGHUP, SIGTERM}) {
    CAPTURE(signal);
    interrupt_a_run(signal);
  }
}

TEST_CASE("signals that ask for an end at once leave no temporary file, either") {
  const TempFolder folder;
  const std::string mesh = folder.file("torus.obj");
  REQUIRE(run_workbench({"make", "torus", "--out", mesh}).exit_code == 0);
  std::string text = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 30000; ++i) text += std::to_string(i) + "e-3,0.0" + std::to_string(1 + i % 7) + ",0.01,0.02\n";
  const std::string poses = folder.write("poses.csv", text);
  for (const std::vector<int>& signals : {std::vector<int>{SIGQUIT}, {SIGABRT}, {SIGPIPE}, {SIGINT, SIGINT}}) {
    CAPTURE(signals.front());
    const Process process({"solve", mesh, "--poses", poses, "--out", folder.file("ticks.csv"), "--method", "paper",
                           "--gain-curvature-m", "0", "--max-iterations", "1000", "--tolerance-um", "1e-6"});
    REQUIRE(comes_to_write(folder));
    for (const int signal : signals) process.interrupt(signal);
    process.wait();
    CHECK_FALSE(half_written(folder));
  }
}

TEST_CASE("solve --explain says for each tick that wants it why, and counts the causes") {
  const SolveScene scene(40);
  const ProcessResult plain = scene.solve({"--explain", "--summary", scene.folder.file("summary.json")});
  CHECK(plain.exit_code == 0);
  CHECK(plain.out.find("tick 0 at 0 s, face, event first") != std::string::npos);
  CHECK(plain.out.find("explained   first-contact 1\n") != std::string::npos);
  const Rows as_without = scene.ticks();
  const ProcessResult slow = scene.solve({"--explain", "--method", "paper", "--gain-overall", "0.1", "--many-planes",
                                          "5", "--summary", scene.folder.file("summary.json")});
  CHECK(slow.exit_code == 0);
  CHECK(slow.out.find("gain-too-small. The gain is too small for the curvature") != std::string::npos);
  CHECK(slow.out.find("Cured by solver.gain_") != std::string::npos);
  CHECK(scene.summary()["explained"]["gain-too-small"].get<int>() > 30);
  CHECK(scene.solve({"--summary", scene.folder.file("summary.json")}).out.find("  explained ") == std::string::npos);
  CHECK(!scene.summary().contains("explained"));
  Rows without = scene.ticks();
  REQUIRE(without.size() == as_without.size());
  for (std::size_t i = 0; i < without.size(); ++i) CHECK(without[i][3] == as_without[i][3]);
  const ProcessResult alone = scene.solve({"--many-planes", "5"});
  CHECK(alone.exit_code == 2);
  CHECK(alone.err.find("is an option of --explain") != std::string::npos);
}
