#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace tangent::testing;

TEST_CASE("compare says whether two recordings are the same, different or not aligned, by its exit code, too") {
  const TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite"), json = folder.file("c.json");
  const auto record = [&](const std::string& to, const std::string& stiffness) {
    REQUIRE(
        run_workbench({"record", "--out", to, "--seconds", "1", "--without-waiting", "--stiffness-n-per-m", stiffness})
            .exit_code == 0);
  };
  record(a, "400");
  record(b, "600");
  const ProcessResult same = run_workbench({"compare", a, a});
  CHECK(same.exit_code == 0);
  CHECK(contains(same.out, "The same, within the tolerances."));
  const ProcessResult other = run_workbench({"compare", a, b, "--finger-tolerance-mm", "100", "--json", json});
  CHECK(other.exit_code == 1);
  CHECK(contains(other.out, "Different."));
  const auto report = nlohmann::json::parse(read_text(json));
  CHECK(report["outcome"] == "different");
  CHECK(report["quantities"][0]["name"] == "force");
  CHECK(report["quantities"][0]["largest_at_most"].get<double>() > 0.01);
  CHECK(run_workbench({"compare", a, b, "--finger-tolerance-mm", "100", "--force-tolerance-n", "1000",
                       "--length-tolerance-um", "1e6"})
            .exit_code == 0);
  CHECK(contains(run_workbench({"compare", a, b, "--coarse", "--finger-tolerance-mm", "100"}).out,
                 "by their minima and maxima"));
  const ProcessResult none = run_workbench({"compare", a, b, "--align", "bookmark"});
  CHECK(none.exit_code == 1);
  CHECK(contains(none.out, "Not aligned: neither has a bookmark."));

  const ProcessResult under = run_workbench({"compare", a, "--stiffness-n-per-m", "400"});
  CHECK(under.exit_code == 0);
  CHECK(contains(under.out, "same motion assumed"));
  CHECK(run_workbench({"compare", a, "--stiffness-n-per-m", "600"}).exit_code == 1);
  CHECK(run_workbench({"compare", a}).exit_code == 2);
  CHECK(run_workbench({"compare", a, b, "--method", "paper"}).exit_code == 2);
  CHECK(run_workbench({"compare", a, "--method", "paper", "--coarse"}).exit_code == 2);
  CHECK(run_workbench({"compare", a, folder.file("none.sqlite")}).exit_code == 1);
}

TEST_CASE("compare and replay draw the curves of both with their difference") {
  const TempFolder folder;
  const std::string a = folder.file("a.sqlite");
  REQUIRE(run_workbench({"record", "--out", a, "--seconds", "1.1", "--without-waiting"}).exit_code == 0);
  for (const char* command : {"compare", "replay"}) {
    const std::string figures = folder.file(command);
    run_workbench({command, a, "--stiffness-n-per-m", "600", "--figures", figures, "--json", figures + ".json"});
    for (const char* name : {"force", "display", "solver"}) {
      const std::string file = figures + "/comparison-" + name;
      CHECK(contains(read_text(file + ".svg"), "<svg"));
      CHECK(contains(read_text(file + ".csv"), "t_s,least_a0,most_a0,least_b0,most_b0,difference0"));
    }
    CHECK(contains(read_text(figures + "/comparison-spectrum.svg"), "<svg"));
    CHECK(contains(read_text(figures + "/comparison-spectrum.csv"), "hz,force_n2_per_hz_1,force_n2_per_hz_2,"));
    const auto report = nlohmann::json::parse(read_text(figures + ".json"));
    const auto& first = report.contains("spectra") ? report["spectra"]["first"] : report["recorded"]["spectrum"];
    CHECK(first["windows"] == 1);
    CHECK(first["window_ticks"] == 1024);
    CHECK(first["hz"][0].get<double>() >= 20.0);
    CHECK(first["hz"].size() == first["force_n2_per_hz"].size());
    CHECK(first["hz"].size() == first["display_mm2_per_hz"].size());
  }
}
