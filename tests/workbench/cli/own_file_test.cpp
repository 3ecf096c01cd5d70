// No command writes over a file of another kind.
#include "tests/support/process.h"

namespace tangent {
namespace {

using testing::contains;
using testing::read_text;
using testing::run_workbench;
using testing::TempFolder;

TEST_CASE("every output replaces a file of its own kind, and no other, naming it") {
  const TempFolder folder;
  const std::string mesh = folder.file("cube.obj"), recording = folder.file("r.sqlite"),
                    poses =
                        folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0.03,0.001,0.055\n0.001,0.0301,0.001,0.055\n");
  const auto out = [&](const char* name) { return folder.file(name); };
  REQUIRE(run_workbench({"make", "cube", "--out", mesh}).exit_code == 0);
  REQUIRE(run_workbench({"record", "--out", recording, "--seconds", "0.1", "--without-waiting"}).exit_code == 0);
  constexpr const char* kMine[]{"notes of mine\n", "{\"mine\": 1}\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"};
  std::size_t row = 0;
  using Command = std::vector<std::string>;
  for (const auto& [command, file] : std::initializer_list<std::pair<Command, std::string>>{
           {{"make", "torus", "--out", out("made.obj")}, out("made.obj")},
           {{"make", "arc", "--out", out("arc.obj")}, out("arc.obj")},
           {{"make", "arc", "--out", out("arc.csv")}, out("arc.csv")},
           {{"solve", mesh, "--poses", poses, "--out", out("ticks.csv")}, out("ticks.csv")},
           {{"solve", mesh, "--poses", poses, "--out", "/dev/null", "--summary", out("s.json")}, out("s.json")},
           {{"solve", mesh, "--poses", poses, "--out", "/dev/null", "--iterations", out("i.csv")}, out("i.csv")},
           {{"explain", recording, "--json", out("why.json")}, out("why.json")},
           {{"explain", recording, "--tick", "50", "--json", out("tick.json")}, out("tick.json")},
           {{"export", recording, "--out", out("e.csv"), "--channels", "force_x_n"}, out("e.csv")},
           {{"export", recording, "--out", out("e.mcap")}, out("e.mcap")},
           {{"replay", recording, "--json", out("replay.json")}, out("replay.json")},
           {{"replay", recording, "--method", "newton", "--json", out("other.json")}, out("other.json")},
           {{"compare", recording, recording, "--json", out("compare.json")}, out("compare.json")},
           {{"devices", "--json", out("devices.json")}, out("devices.json")},
           {{"audit", mesh, "--json", out("audit.json"), "--heat-map", out("heat.csv")}, out("audit.json")},
           {{"audit", mesh, "--json", out("audit2.json"), "--heat-map", out("heat2.csv")}, out("heat2.csv")}}) {
    CAPTURE(command[0] + " " + file);
    for (int again = 0; again < 2; ++again) {
      const auto written = run_workbench(command);
      CHECK_MESSAGE(written.exit_code == 0, written.err);
    }
    const char* const mine = kMine[row++ % std::size(kMine)];
    std::filesystem::remove(file);
    { std::ofstream(file, std::ios::binary) << mine; }
    const auto refused = run_workbench(command);
    CHECK(refused.exit_code == 1);
    CHECK(contains(refused.err, file + ": is there already, and is not "));
    CHECK(contains(refused.err, "which alone is replaced; choose another name, or remove it"));
    CHECK(read_text(file) == mine);
  }
  const std::string twice = folder.write("twice", kMine[0]);  // two outputs with one name are none that reads it
  CHECK(run_workbench({"solve", mesh, "--poses", poses, "--out", twice, "--summary", twice}).exit_code == 1);
  CHECK(read_text(twice) == kMine[0]);
  const std::string empty = folder.write("empty.obj", "");
  CHECK(run_workbench({"make", "cube", "--out", empty}).exit_code == 0);  // nothing is lost with it
}

TEST_CASE("a dash for an output is refused, and no file of that name is written") {
  const TempFolder folder;
  const std::string mesh = folder.file("cube.obj");
  REQUIRE(run_workbench({"make", "cube", "--out", mesh}).exit_code == 0);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"make", "cube", "--out", "-"},
                                                  {"audit", mesh, "--json", "-"},
                                                  {"devices", "--json", "-"}}) {
    CAPTURE(command[0]);
    const auto refused = run_workbench(command);
    CHECK(refused.exit_code == 2);
    CHECK(contains(refused.err, "- would be a file of that name, not standard output"));
    CHECK(!std::filesystem::exists("-"));
  }
}

TEST_CASE("figures and the page of a report replace their own, and write nothing where another has their name") {
  const TempFolder folder;
  const std::string recording = folder.file("r.sqlite"), figures = folder.file("figures"),
                    report = folder.file("report"), notes = "notes of mine\n";
  REQUIRE(run_workbench({"record", "--out", recording, "--seconds", "1.2", "--without-waiting"}).exit_code == 0);
  const std::vector<std::string> command{"replay", recording, "--method", "newton", "--figures", figures};
  for (int again = 0; again < 2; ++again) {
    const auto written = run_workbench(command);
    REQUIRE_MESSAGE(written.exit_code == 0, written.err);
  }
  for (const char* const name : {"/comparison-force.svg", "/comparison-force.csv"}) {
    const std::string theirs = read_text(figures + name);
    { std::ofstream(figures + name) << notes; }
    const auto refused = run_workbench(command);
    CHECK(refused.exit_code == 1);
    CHECK(contains(refused.err, figures + name + ": is there already, and is not "));
    CHECK(read_text(figures + name) == notes);
    { std::ofstream(figures + name) << theirs; }
  }
  std::filesystem::create_directory(report);
  { std::ofstream(report + "/report.html") << notes; }
  const auto refused = run_workbench({"report", recording, "--out", report});
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.err, "report.html: is there already, and is not a report"));
  CHECK(read_text(report + "/report.html") == notes);
}

TEST_CASE("a log of packets replaces one of packets only") {
  const TempFolder folder;
  const std::string notes = folder.write("notes.txt", "12 in the morning\n");
  const auto refused = run_workbench(
      {"record", "--out", folder.file("r.sqlite"), "--seconds", "0.01", "--without-waiting", "--packets", notes});
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.err, "is not a log of packets"));
  CHECK(read_text(notes) == "12 in the morning\n");
  CHECK(folder.entry_count() == 1);
  for (const char* const log : {"", "0.000125 in 0 8 0102030405060708\n", "12.500000 out 0 0 \n"}) {
    folder.write("notes.txt", log);
    CHECK(run_workbench({"record", "--out", folder.file("r.sqlite"), "--seconds", "0.01", "--without-waiting",
                         "--packets", notes})
              .exit_code == 0);
    std::filesystem::remove(folder.file("r.sqlite"));
  }
}

}  // namespace
}  // namespace tangent
