// workbench report, run as a process.
#include "tests/support/process.h"

#include <doctest/doctest.h>

using namespace tangent::testing;

TEST_CASE("report writes one page of recordings, names its own command, and refuses what is none") {
  const TempFolder folder;
  const std::string a = folder.file("a b.sqlite"), out = folder.file("out");
  REQUIRE(run_workbench({"record", "--out", a, "--seconds", "0.4", "--without-waiting", "--method", "paper",
                         "--gain-curvature-m", "0"})
              .exit_code == 0);
  const ProcessResult made = run_workbench({"report", a, a, "--out", out, "--ticks", "50", "--rounds", "2"});
  REQUIRE(made.exit_code == 0);
  CHECK(contains(made.out, "report.html: 2 recordings"));
  const std::string page = read_text(folder.file("out/report.html"));
  CHECK(contains(page, "workbench report &#39;" + a + "&#39; &#39;" + a + "&#39; --out " + out));
  CHECK(contains(page, "id=\"r2-why\""));
#if defined(TANGENT_HAS_GUI)
  const bool drawn = contains(page, "<img alt=\"The finger and the mesh at the worst tick");
  const bool no_graphics = contains(page, "No picture: ");
  CHECK(drawn != no_graphics);
#endif
  CHECK(run_workbench({"report", a}).exit_code == 2);
  CHECK(run_workbench({"report", "--out", out}).exit_code == 2);
  CHECK(run_workbench({"report", a, "--out", out, "--ticks", "0"}).exit_code == 2);
  const ProcessResult none = run_workbench({"report", folder.file("none.sqlite"), "--out", folder.file("other")});
  CHECK(none.exit_code == 1);
  CHECK(contains(none.err, "none.sqlite"));
  CHECK_FALSE(std::filesystem::exists(folder.file("other")));
  const ProcessResult file = run_workbench({"report", a, "--out", a});
  CHECK(file.exit_code == 1);
  CHECK(contains(file.err, "is no folder"));
}
