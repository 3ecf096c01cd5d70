// workbench bench, run as a process.
#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace tangent::testing;

TEST_CASE("bench prints a table and writes JSON and a plot") {
  const TempFolder folder;
  const std::string json_file = folder.file("b.json"), plot = folder.file("b.svg");
  const ProcessResult result = run_workbench(
      {"bench", "--suite", "paper", "--only", "icosphere", "--ticks", "30", "--json", json_file, "--plot", plot});
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());
  for (const char* word :
       {"icosphere_320", "paper", "newton", "robust", "facet", "force-shading", "embree", "robust: 0 of 30 ticks"})
    CHECK(contains(result.out, word));
  const auto json = nlohmann::json::parse(read_text(json_file));
  CHECK(json["interrupted"] == false);
  REQUIRE(json["scenes"].size() == 1);
  CHECK(json["scenes"][0]["methods"].size() == 6);
  CHECK(json["work_precision"].size() == 3);
  const auto& robust = json["scenes"][0]["methods"][2];
  CHECK(robust["method"] == "robust");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  CHECK(robust["allocations"] == 0);
#endif
  const std::string svg = read_text(plot);
  CHECK(contains(svg, "<svg"));
  CHECK(contains(svg, "Command: workbench bench --ticks 30"));
  CHECK(svg.ends_with("</svg>\n\n"));
  CHECK_FALSE(contains(svg, "nan"));
  CHECK_FALSE(contains(svg, "inf"));
  for (const char* label : {"contact error", "time per tick", "paper, best G", "icosphere_320, 320 triangles",
                            "rgb(213,  94,   0)", "rgb(  0, 158, 115)"})
    CHECK(contains(svg, label));
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("the strokes of the paper's participants take two to three planes a tick with the gains stated") {
  const TempFolder folder;
  const ProcessResult result = run_workbench({"bench", "--suite", "strokes", "--only", "cube_strokes", "--ticks",
                                              "5000", "--repeats", "1", "--json", folder.file("b.json")});
  REQUIRE(result.exit_code == 0);
  CHECK(contains(result.out, "G_k 19 mm"));
  CHECK(contains(result.out, "strokes suite: paper takes "));
  CHECK(contains(result.out, " over 1 objects"));
  const auto json = nlohmann::json::parse(read_text(folder.file("b.json")));
  REQUIRE(json["scenes"].size() == 1);
  CHECK(json["scenes"][0]["methods"][0]["method"] == "paper");
  CHECK(json["scenes"][0]["methods"][0]["gain_curvature_m"] == 0.019);
}

TEST_CASE("bench runs real meshes from folders and says what is wrong with them") {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "meshes");
  std::filesystem::create_directory(folder.path() / "poses");
  const std::string meshes = folder.file("meshes"), poses = folder.file("poses");
  const auto run = [&] {
    return run_workbench({"bench", "--only", "ball", "--meshes", meshes, "--poses", poses, "--repeats", "1"});
  };

  CHECK(run().exit_code == 1);  // no pose file
  folder.write("poses/ball-r020.csv", "t_s,x_m,y_m,z_m\n0,0.0595,0,0\n0.001,0.0595,0.0001,0\n");
  const ProcessResult no_mesh = run();
  CHECK(no_mesh.exit_code == 1);
  CHECK(contains(no_mesh.err, "ball.obj"));
  REQUIRE(run_workbench({"make", "icosphere", "--out", folder.file("meshes/ball.obj")}).exit_code == 0);
  const ProcessResult good = run();
  CHECK(good.exit_code == 0);
  CHECK(contains(good.out, "shared / ball-r020_crease_180"));
  CHECK(contains(good.out, "shared / ball-r020_crease_45"));
  folder.write("poses/ball.csv", "t_s,x_m,y_m,z_m\n0,0,0,0.06\n");
  const ProcessResult unnamed = run();
  CHECK(unnamed.exit_code == 1);
  CHECK(contains(unnamed.err, "ball.csv"));
}

TEST_CASE("bench refuses what makes no sense before it measures") {
  const TempFolder folder;
  CHECK(run_workbench({"bench", "--suite", "easy"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--ticks", "0"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--ticks", "nan"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--repeats", "1.5"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--meshes", folder.file("m")}).exit_code == 2);
  CHECK(run_workbench({"bench", "--json", folder.file("a"), "--plot", folder.file("a")}).exit_code == 2);
  const ProcessResult unwritable = run_workbench({"bench", "--json", folder.file("no/b.json")});
  CHECK(unwritable.exit_code == 1);
  CHECK(contains(unwritable.err, folder.file("no/b.json")));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("Ctrl-C keeps what was measured and says so") {
  const TempFolder folder;
  const std::string json_file = folder.file("b.json");
  const Process process({"bench", "--suite", "paper", "--ticks", "2000000", "--repeats", "20", "--json", json_file});
  ::usleep(3'000'000);
  process.interrupt();
  const ProcessResult result = process.wait();
  CHECK(result.exit_code == 1);
  CHECK(contains(result.err, "interrupted"));
  CHECK(nlohmann::json::parse(read_text(json_file))["interrupted"] == true);
}

TEST_CASE("bench --mesh measures curves on a mesh and motion of one's own, with table, CSV, JSON and plot") {
  const TempFolder folder;
  const std::string mesh = folder.file("ball.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
  std::string poses = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 40; ++i) poses += std::to_string(1e-3 * i) + ",0.0592," + std::to_string(1e-4 * i) + ",0.0001\n";
  const ProcessResult result =
      run_workbench({"bench", "--mesh", mesh, "--poses", folder.write("p.csv", poses), "--finger-radius-mm", "20",
                     "--methods", "robust,facet", "--rounds", "2", "--seed", "9", "--csv", folder.file("c.csv"),
                     "--json", folder.file("c.json"), "--plot", folder.file("c.svg")});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  for (const char* word : {"40 ticks, 2 rounds in turns, there and back, seed 9", "robust", "facet", "embree bounded",
                           "tolerance", "limit 8", "preset", "Fastest for an error"})
    CHECK(contains(result.out, word));
  CHECK_FALSE(contains(result.out, "newton"));
  const auto json = nlohmann::json::parse(read_text(folder.file("c.json")));
  CHECK(json["seed"] == 9);
  CHECK(json["ticks"] == 40);
  CHECK(json["points"].size() == 1 + 9 + 8 + 1);
  CHECK(contains(json["origin"]["Command"].get<std::string>(), "--mesh " + mesh));
  const std::string csv = read_text(folder.file("c.csv")), svg = read_text(folder.file("c.svg"));
  CHECK(contains(csv, "# Command: workbench bench "));
  CHECK(contains(csv, "# Seed: 9\nmethod,swept,tolerance_m,"));
  CHECK(contains(svg, "<svg"));
  CHECK(contains(svg, "--seed 9"));
  CHECK_FALSE(contains(svg, "nan"));
  CHECK(contains(svg, "iteration limit"));

  // Without poses the simulated hand explores.
  const ProcessResult explored = run_workbench({"bench", "--mesh", mesh, "--ticks", "30", "--methods", "newton",
                                                "--rounds", "1", "--no-peers", "--finger-radius-mm", "5"});
  CHECK(explored.exit_code == 0);
  CHECK(contains(explored.out, "30 ticks, 1 round in turns"));
  CHECK_FALSE(contains(explored.out, "inf"));  // one round has no interval
  CHECK_FALSE(contains(explored.out, "embree"));
}

TEST_CASE("bench --mesh remarks on a motion that touches nothing") {
  const TempFolder folder;
  const std::string mesh = folder.file("ball.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
  const std::string poses = folder.write("mm.csv", "t_s,x_m,y_m,z_m\n0,59,0,0\n0.001,59,0,1\n");
  const ProcessResult done = run_workbench({"bench", "--mesh", mesh, "--poses", poses, "--methods", "robust",
                                            "--no-peers", "--rounds", "1", "--seconds", "0"});
  CHECK(done.exit_code == 0);
  CHECK(
      contains(done.err, "workbench bench: the finger touched nothing in 2 of 2 ticks; the nearest it came was 58.9"));
}

TEST_CASE("bench --mesh refuses what makes no sense") {
  const TempFolder folder;
  const std::string mesh = folder.file("ball.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
  CHECK(run_workbench({"bench", "--csv", folder.file("c.csv")}).exit_code == 2);
  CHECK(run_workbench({"bench", "--poses", folder.file("c.csv")}).exit_code == 2);
  CHECK(run_workbench({"bench", "--suite", "paper", "--tolerance-um", "1"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--suite", "paper", "--methods", "robust"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--mesh", mesh, "--only", "cube"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--mesh", mesh, "--meshes", "m", "--poses", "p"}).exit_code == 2);
  CHECK(run_workbench({"bench", "--mesh", mesh, "--csv", "a.svg", "--plot", "a.svg"}).exit_code == 2);
  const ProcessResult method = run_workbench({"bench", "--mesh", mesh, "--methods", "magic"});
  CHECK(method.exit_code == 2);
  CHECK(contains(method.err, "magic"));
  CHECK(contains(method.err, "two-pass"));
  const ProcessResult planar =
      run_workbench({"bench", "--mesh", folder.write("o.csv", "x_m,y_m\n0,0\n0.05,0\n0.05,0.05\n"), "--ticks", "5"});
  CHECK(planar.exit_code == 1);
  CHECK(contains(planar.err, "2D"));
  const ProcessResult missing = run_workbench({"bench", "--mesh", folder.file("none.obj")});
  CHECK(missing.exit_code == 1);
  CHECK(contains(missing.err, "none.obj"));
  CHECK(folder.entry_count() == 2);
  const std::string notes = folder.write("notes.txt", "{mine}");
  for (const char* const option : {"--json", "--csv"}) {
    const ProcessResult foreign = run_workbench({"bench", "--mesh", mesh, option, notes, "--ticks", "5"});
    CHECK(foreign.exit_code == 1);
    CHECK(contains(foreign.err, "notes.txt: is there already, and is not"));
  }
  CHECK(run_workbench({"bench", "--json", notes, "--only", "none"}).exit_code == 1);
  CHECK(read_text(notes) == "{mine}");
}

TEST_CASE("bench: options that would have no effect, and a scene that is none, are wrong usage") {
  const TempFolder folder;
  const std::string mesh = folder.file("ball.obj");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
  const std::vector<std::string> own{"bench", "--mesh", mesh, "--ticks", "5"}, suite{"bench", "--ticks", "5"};
  const auto refused = [](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.end(), more.begin(), more.end());
    const ProcessResult result = run_workbench(command);
    CHECK(result.exit_code == 2);
    return result.err;
  };
  CHECK(contains(refused(own, {"--suite", "hard"}), "--suite: is of the suites; leave it out with --mesh"));
  CHECK(contains(refused(own, {"--repeats", "2"}), "--repeats: "));
  CHECK(contains(refused(own, {"--max-triangles", "2000"}), "--max-triangles: "));
  CHECK(contains(refused(own, {"--method", "newton"}), "--method: is one method; with --mesh all are measured"));
  CHECK(contains(refused(suite, {"--rounds", "2"}), "--rounds: requires --mesh F"));
  CHECK(contains(refused(suite, {"--seconds", "2"}), "--seconds: requires --mesh F"));
  CHECK(contains(refused(suite, {"--seed", "2"}), "--seed: requires --mesh F"));
  CHECK(contains(refused(suite, {"--no-peers"}), "--no-peers: requires --mesh F"));
  CHECK(contains(refused(suite, {"--only", "cube_shrap"}),
                 "no scene has 'cube_shrap' in its name; the nearest are cube_sharp"));
  CHECK(contains(refused(suite, {"--suite", "scale", "--only", "torus"}), "--only: chooses among the scenes"));
}
