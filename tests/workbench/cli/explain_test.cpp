#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace tangent::testing;

TEST_CASE("explain says why a recorded tick took many planes, and sums up a whole recording") {
  const TempFolder folder;
  const std::string recording = folder.file("a.sqlite"), json = folder.file("w.json");
  REQUIRE(run_workbench({"make", "torus", "--out", folder.file("torus.obj")}).exit_code == 0);
  REQUIRE(run_workbench({"record", folder.file("torus.obj"), "--out", recording, "--seconds", "2", "--without-waiting",
                         "--method", "paper", "--gain-overall", "0.05"})
              .exit_code == 0);
  const ProcessResult all = run_workbench({"explain", recording, "--json", json});
  CHECK(all.exit_code == 0);
  CHECK(contains(all.out, "of 2000 ticks want explaining."));
  CHECK(contains(all.out, "gain-too-small"));
  const auto report = nlohmann::json::parse(read_text(json));
  CHECK(report["complete"] == true);
  CHECK(report["wanted"].get<int>() > 0);
  nlohmann::json gain;
  for (const auto& cause : report["causes"])
    if (cause["cause"] == "gain-too-small") gain = cause["worst"];
  REQUIRE(gain.is_object());

  const std::string tick = std::to_string(gain["tick"].get<int>());
  const ProcessResult one = run_workbench({"explain", recording, "--tick", tick, "--json", json});
  CHECK(one.exit_code == 0);
  CHECK(contains(one.out, "Tick " + tick + " at "));
  CHECK(contains(one.out, "ideal gain in the direction of travel"));
  auto again = nlohmann::json::parse(read_text(json));
  CHECK(again["format"] == 1);
  again.erase("format");
  CHECK(again == gain);
  CHECK(again["same_bits"] == true);
  CHECK(again["decided"]["margin"].get<double>() < 0.0);

  CHECK(run_workbench({"explain", recording, "--tick", "2000"}).exit_code == 1);
  CHECK(run_workbench({"explain", recording, "--tick", "-1"}).exit_code == 2);
  CHECK(run_workbench({"explain"}).exit_code == 2);
  CHECK(run_workbench({"explain", folder.write("b.sqlite", "no database")}).exit_code == 1);
}
