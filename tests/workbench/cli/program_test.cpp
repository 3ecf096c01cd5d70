// The program's conventions: exit codes, help, and invalid arguments.
#include "core/preset/schema.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/sanitized.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::testing;

namespace {

/// A solve that would work, with one more option.
ProcessResult solve_with(const std::string& option, const std::string& value) {
  return run_workbench({"solve", "mesh.obj", "--poses", "poses.csv", "--out", "ticks.csv", option, value});
}

void check_refused(const ProcessResult& result, const std::string& message) {
  CHECK(result.exit_code == 2);
  CHECK(result.out.empty());
  CAPTURE(result.err);
  CHECK(contains(result.err, message));
}

}  // namespace

TEST_CASE("help and version leave with 0") {
  const ProcessResult help = run_workbench({"--help"});
  CHECK(help.exit_code == 0);
  for (const char* command : {"solve", "audit", "make"}) {
    CHECK(contains(help.out, command));
    const ProcessResult own = run_workbench({command, "--help"});
    CHECK(own.exit_code == 0);
    CHECK(contains(own.out, "Usage: workbench " + std::string(command)));
  }
  const ProcessResult version = run_workbench({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(contains(version.out, "workbench "));
}

TEST_CASE("wrong usage leaves with 2 and says what is wrong") {
  check_refused(run_workbench({"frobnicate"}), "not expected: frobnicate");
  check_refused(run_workbench({"--frobnicate"}), "not expected: --frobnicate");
  check_refused(run_workbench({"solve"}), "MESH is required");
  check_refused(run_workbench({"solve", "mesh.obj", "--out", "ticks.csv"}), "--poses is required");
  check_refused(run_workbench({"solve", "mesh.obj", "--poses"}), "--poses");
  check_refused(run_workbench({"audit", "mesh.obj", "another.obj"}), "not expected: another.obj");
  check_refused(run_workbench({"make", "cube"}), "--out is required");
  check_refused(run_workbench({"audit", "mesh.obj", "--bogus", "3"}), "workbench audit: not expected: --bogus 3 (see");
  check_refused(run_workbench({"solve", "m.obj", "--method", "paper", "--method", "robust"}),
                "--method: is given more than once; give it once (see");
}

TEST_CASE("no option takes nan, inf or text for a number" * doctest::skip(testing::kSanitized)) {
  std::vector<std::string> options{"--fit-mm", "--crease-deg"};
  for (const PresetKey& key : preset_keys())
    if (!key.option.empty() && key.kind != KeyKind::choice) options.push_back("--" + std::string(key.option));
  for (const std::string& option : options) {
    for (const char* bad : {"nan", "-nan", "inf", "-inf", "1e999", "", "5mm", "0x10", "1,5"}) {
      CAPTURE(option);
      CAPTURE(bad);
      check_refused(solve_with(option, bad), option + ": '" + bad + "' is not a finite number; allowed: ");
    }
  }
}

TEST_CASE("numbers out of range are refused with the option and the range") {
  check_refused(solve_with("--tolerance-um", "-1"), "--tolerance-um: -1 is out of range; allowed: 1e-06 to 1000 um");
  check_refused(solve_with("--tolerance-um", "0"), "--tolerance-um: 0 is out of range");
  check_refused(solve_with("--gain-overall", "10.001"), "--gain-overall: 10.001 is out of range; allowed: 0 to 10");
  check_refused(solve_with("--gain-curvature-m", "-0.1"), "allowed: 0 to 10 m");
  check_refused(solve_with("--gain-distance-per-m", "1e6"), "allowed: 0 to 100000 1/m");
  check_refused(solve_with("--max-iterations", "0"), "allowed: a whole number from 1 to 10000");
  check_refused(solve_with("--max-iterations", "2.5"), "--max-iterations: 2.5 is not a whole number");
  check_refused(solve_with("--finger-radius-mm", "1001"), "allowed: 0 to 1000 mm");
  check_refused(solve_with("--stiffness-n-per-m", "-800"), "allowed: 0 to 100000 N/m");
  check_refused(solve_with("--crease-deg", "181"), "allowed: 0 to 180 deg");
  check_refused(solve_with("--fit-mm", "0"), "--fit-mm: 0 is out of range");
}

TEST_CASE("unknown words are refused with the ones there are") {
  check_refused(solve_with("--method", "magic"), "--method: 'magic' is unknown; allowed: paper, newton, robust, facet");
  check_refused(solve_with("--condition", "C5"), "allowed: C1, C2, C3, C4, P1, P2, force-unshaded");
  check_refused(solve_with("--normal-form", "phong"), "allowed: bernstein or vlachos");
  check_refused(solve_with("--unit", "ft"), "allowed: mm, cm, m or in");
  check_refused(solve_with("--normals", "none"), "allowed: auto, file or computed");
}

TEST_CASE("an output that would overwrite an input or another output is refused") {
  check_refused(run_workbench({"solve", "m.obj", "--poses", "p.csv", "--out", "p.csv"}),
                "--out: names the same file as --poses");
  check_refused(run_workbench({"solve", "m.obj", "--poses", "p.csv", "--out", "t.csv", "--summary", "t.csv"}),
                "--summary: names the same file as --out");
  const TempFolder folder;
  const std::string mesh = folder.write("m.obj", "v 0 0 0\n");
  check_refused(run_workbench({"solve", mesh, "--poses", "p.csv", "--out",
                               folder.file("../") + folder.path().filename().string() + "/m.obj"}),
                "--out: names the same file as MESH");
  CHECK(read_text(mesh) == "v 0 0 0\n");
}

namespace {

/// The program alone in a folder, as someone would copy it.
std::string copied_program(const TempFolder& folder) {
  const std::string program = folder.file("workbench");
  std::filesystem::copy_file(testing::program(), program);
  return program;
}

}  // namespace

TEST_CASE("the program loads no graphics: those belong to the window's own") {
  const Process ldd({testing::program()}, "/usr/bin/ldd");
  const ProcessResult loaded = ldd.wait();
  REQUIRE(loaded.exit_code == 0);
  CHECK(contains(loaded.out, "libembree3"));
  for (const char* library : {"libglfw", "libX11", "libGL", "libEGL", "libepoxy", "libfreetype", "libimgui"}) {
    CAPTURE(library);
    CHECK_FALSE(contains(loaded.out, library));
  }
}

TEST_CASE("gui and shot become the program beside this one, with the same arguments and its exit code") {
  const TempFolder folder;
  const std::string program = copied_program(folder);
  const std::string window = folder.write("workbench-window", "#!/bin/sh\necho window \"$@\"\nexit 7\n");
  std::filesystem::permissions(window, std::filesystem::perms::owner_all);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"gui", "a mesh.obj", "--servo-hz", "500"}, {"shot", "--view", "list"}, {}}) {
    std::string expected = "window";
    for (const std::string& argument : arguments) expected += " " + argument;
    const ProcessResult result = Process(arguments, program).wait();
    CHECK(result.exit_code == 7);
    CHECK(result.out == expected + "\n");
  }
  CHECK(Process({"--version"}, program).wait().exit_code == 0);
  // Through a link from elsewhere it still finds what lies beside the file itself.
  const TempFolder elsewhere;
  std::filesystem::create_symlink(program, elsewhere.file("workbench"));
  CHECK(Process({"gui"}, elsewhere.file("workbench")).wait().exit_code == 7);
}

TEST_CASE("without the window's program gui and shot say what is missing, and the rest works") {
  const TempFolder folder;
  const std::string program = copied_program(folder);
  for (const char* command : {"gui", "shot"}) {
    const ProcessResult result = Process({command}, program).wait();
    CHECK(result.exit_code == 1);
    CHECK(contains(result.err, "workbench " + std::string(command) + ": "));
    CHECK(contains(result.err, "/workbench-window: can't be started: No such file or directory; "));
    CHECK(contains(result.err, "belongs beside this one"));
  }
  const ProcessResult alone = Process({}, program).wait();
  CHECK(alone.exit_code == 0);
  CHECK(contains(alone.out, "The built-in scene"));
  CHECK(Process({"make", "cube", "--out", folder.file("cube.obj")}, program).wait().exit_code == 0);
  const ProcessResult help = Process({"--help"}, program).wait();
  CHECK(contains(help.out, "gui"));
  CHECK(contains(help.out, "shot"));
}
