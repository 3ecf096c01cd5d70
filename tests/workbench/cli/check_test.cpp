// workbench check, run as a process: exit codes, JSON, attaching, and the presets that ship.
#include "core/io/preset_file.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/sanitized.h"

#include <doctest/doctest.h>

#include <filesystem>

using namespace tangent;
using namespace tangent::testing;

namespace {

/// A preset with evidence over three poses on a made mesh.
struct CheckFolder {
  TempFolder folder;
  std::string preset = folder.file("p.toml");
  std::string poses =
      folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0,0,0.059\n0.001,0.0001,0,0.059\n0.002,0.0002,0,0.059\n");
  CheckFolder() {
    REQUIRE(write_preset({}, preset));
    const ProcessResult attached = attach("make icosphere");
    REQUIRE(attached.exit_code == 0);
    CHECK(contains(attached.out, "p.toml written: 3 ticks on icosphere"));
  }
  ProcessResult attach(const std::string& mesh) const {
    return run_workbench({"check", preset, "--attach", "--mesh", mesh, "--poses", poses});
  }
  void edit(const std::string& from, const std::string& to) const {
    std::string text = read_text(preset);
    const std::size_t at = text.rfind(from);
    REQUIRE(at != std::string::npos);
    folder.write("p.toml", text.replace(at, from.size(), to));
  }
};

}  // namespace

TEST_CASE("check exits 0 where presets hold, 1 where one changed and 3 where one can't be checked") {
  const CheckFolder f;
  const ProcessResult holds = run_workbench({"check", f.preset, f.preset});
  CHECK(holds.exit_code == 0);
  CHECK(contains(holds.out, "p.toml holds: 3 ticks, 0 unconverged, mean "));
  CHECK(contains(holds.out, "to the last bit"));
  const std::string bare = f.folder.file("bare.toml");
  REQUIRE(write_preset({}, bare));
  const ProcessResult cant = run_workbench({"check", f.preset, bare});
  CHECK(cant.exit_code == 3);
  CHECK(contains(cant.out, "bare.toml can't be checked: it names nothing"));
  f.edit("limit_n = 8.5", "limit_n = 8.25");
  const std::string json = f.folder.file("check.json");
  const ProcessResult changed = run_workbench({"check", bare, f.preset, "--json", json});
  CHECK(changed.exit_code == 1);
  CHECK(contains(changed.out, "p.toml changed\n  force.limit_n: 8.5 when measured, 8.25 now\n"));
  const std::string report = read_text(json);
  CHECK(contains(report, "\"outcome\": \"can't be checked\""));
  CHECK(contains(report, "\"what\": \"force.limit_n\""));
  CHECK(contains(report, "\"mean_planes\": "));
  CHECK(run_workbench({"check", f.folder.file("none.toml")}).exit_code == 3);
}

TEST_CASE("a recording is evidence with its own mesh, and one that was made anew is found") {
  const CheckFolder f;
  const std::string mesh = f.folder.file("ball.obj"), recording = f.folder.file("r.sqlite");
  REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0);
  const auto record = [&] {
    return run_workbench({"solve", mesh, "--poses", f.poses, "--out", f.folder.file("t.csv"), "--record", recording});
  };
  REQUIRE(record().exit_code == 0);
  REQUIRE(run_workbench({"check", f.preset, "--attach", "--recording", recording}).exit_code == 0);
  const Result<PresetFile> file = read_preset(f.preset);
  REQUIRE(file);
  CHECK(file->about.measured->motion.kind == MotionKind::recording);
  CHECK(file->about.measured->motion.file == "r.sqlite");
  CHECK(file->about.measured->mesh.source.empty());
  CHECK(run_workbench({"check", f.preset}).exit_code == 0);
  std::filesystem::remove(recording);
  const ProcessResult gone = run_workbench({"check", f.preset});
  CHECK(gone.exit_code == 3);
  CHECK(contains(gone.out, "r.sqlite: is not there"));
  f.folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0,0,0.059\n0.001,0.0001,0,0.059\n0.002,0.0003,0,0.059\n");
  REQUIRE(record().exit_code == 0);
  const ProcessResult other = run_workbench({"check", f.preset});
  CHECK(other.exit_code == 1);
  CHECK(contains(other.out, "\n  motion: "));
}

TEST_CASE("check refuses wrong usage, and attaches all or nothing") {
  const CheckFolder f;
  const std::string before = read_text(f.preset);
  const ProcessResult failed = f.attach("no_such_mesh.obj");
  CHECK(failed.exit_code == 1);
  CHECK(contains(failed.err, "no_such_mesh.obj: is not there"));
  CHECK(read_text(f.preset) == before);
  CHECK(run_workbench({"check"}).exit_code == 2);
  CHECK(run_workbench({"check", f.preset, "--poses", f.poses}).exit_code == 2);
  CHECK(run_workbench({"check", f.preset, "--attach"}).exit_code == 2);
  CHECK(run_workbench({"check", f.preset, f.preset, "--attach", "--mesh", "make torus"}).exit_code == 2);
  CHECK(run_workbench({"check", f.preset, "--attach", "--mesh", "make torus", "--path", "zigzag"}).exit_code == 2);
}

TEST_CASE("every preset that ships holds" * doctest::skip(testing::kSanitized)) {
  std::vector<std::string> arguments{"check"};
  for (const auto& entry : std::filesystem::directory_iterator(testing::source_folder() + "/presets")) {
    if (entry.path().extension() == ".toml") arguments.push_back(entry.path().string());
  }
  REQUIRE(arguments.size() > 9);
  const ProcessResult result = run_workbench(arguments);
  MESSAGE(result.out);
  CHECK(result.exit_code == 0);
}
