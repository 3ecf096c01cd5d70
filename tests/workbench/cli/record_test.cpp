#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <sqlite3.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <thread>

using namespace tangent::testing;

namespace {

/// A torus recorded without waiting.
std::string record_torus(const TempFolder& folder, const std::vector<std::string>& more = {}) {
  const std::string mesh = folder.file("torus.obj"), recording = folder.file("a.sqlite");
  REQUIRE(run_workbench({"make", "torus", "--out", mesh}).exit_code == 0);
  std::vector<std::string> arguments{"record", mesh, "--out", recording, "--seconds", "2", "--without-waiting"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProcessResult r = run_workbench(arguments);
  REQUIRE(r.exit_code == 0);
  CHECK(contains(r.out, "2000 ticks, 0 missing"));
  return recording;
}

void change_recording(const std::string& path, const char* sql) {
  sqlite3* connection = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &connection) == SQLITE_OK);
  CHECK(sqlite3_exec(connection, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(connection);
}

}  // namespace

TEST_CASE("what record writes, replay computes again bit for bit, and says where it can't") {
  const TempFolder folder;
  const std::string recording = record_torus(folder), json = folder.file("r.json");
  const ProcessResult same = run_workbench({"replay", recording, "--json", json});
  CHECK(same.exit_code == 0);
  CHECK(contains(same.out, "2000 ticks of 2000"));
  CHECK(contains(same.out, "The same bits."));
  const auto report = nlohmann::json::parse(read_text(json));
  CHECK(report["same_bits"] == true);
  CHECK(report["ticks_checked"] == 2000);
  const ProcessResult quick = run_workbench({"replay", recording, "--every-second"});
  CHECK(quick.exit_code == 0);
  CHECK(contains(quick.out, " ticks, those with a kept state, computed again in "));
  // Nothing is written over.
  const ProcessResult again = run_workbench({"record", "--out", recording, "--seconds", "1"});
  CHECK(again.exit_code == 1);
  CHECK(contains(again.err, "is there already"));

  change_recording(recording, "UPDATE tick_rows SET cld_m = cld_m + 1e-6 WHERE tick = 1500");
  const ProcessResult differs = run_workbench({"replay", recording, "--json", json});
  CHECK(differs.exit_code == 1);
  CHECK(contains(differs.out, "1 ticks differ. The first: tick 1500, cld_m: recorded "));
  CHECK(nlohmann::json::parse(read_text(json))["first"]["tick"] == 1500);
}

TEST_CASE("replay under another method or preset compares, and says that it assumes the same motion") {
  const TempFolder folder;
  const std::string recording = record_torus(folder), json = folder.file("r.json");
  const ProcessResult facet = run_workbench({"replay", recording, "--method", "facet", "--json", json});
  CHECK(facet.exit_code == 0);
  CHECK(contains(facet.out, "Same motion assumed"));
  const auto report = nlohmann::json::parse(read_text(json));
  CHECK(report["recorded"]["ticks"] == 2000);
  CHECK(report["difference"]["changed_contacts"].get<int>() > 100);
  const ProcessResult preset = run_workbench({"replay", recording, "--preset", folder.write("p.toml", "[solver]\n")});
  CHECK(preset.exit_code == 0);
  CHECK(contains(preset.out, "force 0 N RMS, at most 0 N"));
  CHECK(run_workbench({"make", "sphere", "--out", folder.file("sphere.obj")}).exit_code == 0);
  const ProcessResult mesh = run_workbench({"replay", recording, "--mesh", folder.file("sphere.obj")});
  CHECK(mesh.exit_code == 0);
  CHECK(contains(mesh.out, "Same motion assumed"));
}

TEST_CASE("a recording without its mesh is replayed on the one that is given") {
  const TempFolder folder;
  const std::string recording = record_torus(folder, {"--no-mesh", "--fit-mm", "90"});
  const std::string mesh = folder.file("torus.obj");
  const ProcessResult alone = run_workbench({"replay", recording});
  CHECK(alone.exit_code == 1);
  CHECK(contains(alone.err, "torus.obj"));
  CHECK(contains(alone.err, "--mesh"));
  CHECK(run_workbench({"replay", recording, "--mesh", mesh, "--fit-mm", "90"}).exit_code == 0);
  CHECK(run_workbench({"replay", recording, "--mesh", mesh}).exit_code == 1);
}

TEST_CASE("solve --record is the same ticks as its CSV, and can be replayed and exported again") {
  const TempFolder folder;
  const std::string mesh = folder.file("torus.obj"), csv = folder.file("t.csv"), recording = folder.file("s.sqlite");
  REQUIRE(run_workbench({"make", "torus", "--out", mesh}).exit_code == 0);
  std::string poses = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 2500; ++i)
    poses +=
        std::to_string(i * 1e-3) + "," + std::to_string(0.0745 - 1e-6 * i) + "," + std::to_string(1e-5 * i) + ",0\n";
  const ProcessResult r = run_workbench({"solve", mesh, "--poses", folder.write("p.csv", poses), "--out", csv,
                                         "--record", recording, "--method", "paper"});
  REQUIRE(r.exit_code == 0);
  const ProcessResult same = run_workbench({"replay", recording});
  CHECK(same.exit_code == 0);
  CHECK(contains(same.out, "2500 ticks of 2500"));
  const std::string exported = folder.file("again.csv");
  REQUIRE(run_workbench({"export", recording, "--out", exported}).exit_code == 0);
  CHECK(read_text(exported) == read_text(csv));
  CHECK(run_workbench({"solve", mesh, "--poses", folder.file("p.csv"), "--out", csv, "--record", csv}).exit_code == 2);
}

TEST_CASE("signals end a recording in order, with every tick in one file") {
  for (const int signal : {SIGINT, SIGHUP, SIGTERM}) {
    CAPTURE(signal);
    const TempFolder folder;
    const std::string recording = folder.file("a.sqlite");
    const Process process({"record", "--out", recording});
    // Before there is a file, a signal ends the program at once.
    while (!process.ended() && folder.entry_count() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // some ticks
    process.interrupt(signal);
    const ProcessResult r = process.wait();
    CHECK(r.exit_code == 0);
    CHECK(contains(r.out, " 0 missing"));
    CHECK(folder.entry_count() == 1);
    CHECK(run_workbench({"replay", recording}).exit_code == 0);
  }
}

TEST_CASE("commands on recordings refuse wrong usage with 2 and files that are none with 1") {
  const TempFolder folder;
  CHECK(run_workbench({"record"}).exit_code == 2);
  CHECK(run_workbench({"record", "--out", folder.file("a.sqlite"), "--without-waiting"}).exit_code == 2);
  CHECK(run_workbench({"record", "--out", folder.file("a.sqlite"), "--seconds", "nan"}).exit_code == 2);
  CHECK(run_workbench({"replay"}).exit_code == 2);
  CHECK(run_workbench({"export", folder.file("a.sqlite")}).exit_code == 2);
  CHECK(run_workbench({"replay", folder.file("a.sqlite")}).exit_code == 1);
  CHECK(run_workbench({"replay", folder.write("b.sqlite", "no database at all")}).exit_code == 1);
  CHECK(run_workbench({"export", folder.file("b.sqlite"), "--out", folder.file("c.csv")}).exit_code == 1);
  const ProcessResult backwards =
      run_workbench({"export", folder.file("b.sqlite"), "--out", folder.file("c.csv"), "--from", "3", "--to", "1"});
  CHECK(backwards.exit_code == 2);
  CHECK(contains(backwards.err, "--to: is before --from"));
  CHECK(run_workbench({"export", folder.file("b.sqlite"), "--out", folder.file("c.docx")}).exit_code == 2);
  CHECK(run_workbench({"export", folder.file("b.sqlite"), "--out", folder.file("c.mat")}).exit_code == 1);
  const ProcessResult channel =
      run_workbench({"export", folder.file("b.sqlite"), "--out", folder.file("c.csv"), "--channels", "colour"});
  CHECK(channel.exit_code == 2);
  CHECK(contains(channel.err, "contact_x_m"));
  CHECK(run_workbench({"record", "--out", folder.file("no/a.sqlite"), "--seconds", "1"}).exit_code == 1);
  CHECK(run_workbench({"record", folder.file("b.sqlite"), "--out", folder.file("d.sqlite")}).exit_code == 1);
  CHECK(folder.entry_count() == 1);
}
