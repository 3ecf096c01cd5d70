// What is asked before a study: the order of conditions, power, and whether protocol and analysis keep what they say.
#include "workbench/analysis/condition_order.h"
#include "workbench/analysis/page_table.h"
#include "workbench/analysis/write_planning.h"

#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "workbench/session/own_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace tangent::analysis {

using test::approx;
namespace {

experiment::Protocol shipped_protocol(const std::string& kind) {
  return *experiment::read_protocol(std::filesystem::path(testing::source_folder()) / "presets" / "experiments" /
                                    (kind + ".toml"));
}

TEST_CASE("Kendall's tau: 1 for the same order, -1 backwards, less for ties") {
  const std::vector<double> up{1.0, 2.0, 3.0, 4.0}, down{4.0, 3.0, 2.0, 1.0}, tied{1.0, 1.0, 2.0, 2.0};
  CHECK(*kendall_tau(up, up) == approx(1.0));
  CHECK(*kendall_tau(up, down) == approx(-1.0));
  CHECK(*kendall_tau(up, tied) == approx(4.0 / std::sqrt(6.0 * 4.0)));
  CHECK_FALSE(kendall_tau(up, std::vector<double>(4, 5.0)));
}

TEST_CASE(
    "conditions in the paper's order agree with it, reversed ones do not, participants that lack one are left out") {
  const std::vector<std::string> names{"C1", "C2", "C3", "P1"};
  const double none = std::nan("");
  const std::vector<std::vector<double>> like{{100, 90, none}, {16, 15, 16}, {250, 260, 240}, {4, 5, 4}};
  const auto agrees = agreement_with_paper(names, like);
  REQUIRE(agrees);
  CHECK(agrees->participants == 2);
  CHECK(agrees->tau == approx(1.0));
  CHECK(agrees->low == approx(1.0));
  const std::vector<std::vector<double>> unlike{{16, 17}, {100, 90}, {4, 5}, {250, 260}};
  CHECK(agreement_with_paper(names, unlike)->tau == approx(-1.0));
  CHECK_FALSE(agreement_with_paper(std::vector<std::string>{"C1", "C2"}, {{1, 2}, {3, 4}}));
}

TEST_CASE("power without a difference is the level, and grows to one") {
  CHECK(paired_t_power(0.0, 12) == approx(0.05));
  CHECK(anova_power(0.0, 4, 12) == approx(0.05));
  CHECK(paired_t_power(3.0, 12) > 0.999);
  CHECK(anova_power(3.0, 4, 12) > 0.999);
  // Of two conditions F is t squared.
  CHECK(anova_power(0.8 * 0.8, 2, 10) == approx(paired_t_power(0.8, 10)).epsilon(1e-6));
}

TEST_CASE("simulated groups find what theory says") {
  constexpr int kGroups = 60;
  for (const char* kind : {"discrimination", "identification"}) {
    const auto simulated = power_table(shipped_protocol(kind), kGroups);
    REQUIRE(simulated);
    const PowerTable& power = *simulated;
    CHECK(power.rows.size() % 7 == 0);
    for (const PowerRow& row : power.rows) {
      CAPTURE(row.test);
      CAPTURE(row.difference);
      CAPTURE(row.participants);
      const double deviation = std::sqrt(row.theory * (1.0 - row.theory) / kGroups);
      CHECK(std::abs(row.found - row.theory) < 4.0 * deviation + 0.05);
      CHECK(row.low <= row.found + 1e-9);
      CHECK(row.found <= row.high + 1e-9);
    }
    for (std::size_t i = 1; i < power.rows.size(); ++i)
      if (power.rows[i].participants > power.rows[i - 1].participants)
        CHECK(power.rows[i].theory >= power.rows[i - 1].theory);
  }
}

TEST_CASE("power of a staircase that never settles is refused, with what to change") {
  experiment::Protocol protocol = shipped_protocol("discrimination");
  for (auto& condition : std::get<experiment::Discrimination>(protocol.kind).conditions) {
    condition.staircase.reversals = condition.staircase.averaged = 1;
    condition.staircase.down = 10;
    condition.staircase.most_trials = 1;
  }
  const auto power = power_table(protocol, 10);
  REQUIRE_FALSE(power);
  const std::string why = power.error().message();
  CAPTURE(why);
  for (const char* part : {"[staircase]", "most_trials = 1 ", "200 of 200", "allow more trials"})
    CHECK(why.find(part) != std::string::npos);
}

TEST_CASE("power stops within the groups of a difference, and has no rows of it then") {
  for (const char* kind : {"discrimination", "identification"}) {
    for (const int until : {0, 10, 4100}) {  // at once, in the many that theory asks for, in the groups
      int asked = 0;
      const auto power = power_table(shipped_protocol(kind), 1'000'000, [&] { return ++asked > until; });
      REQUIRE(power);
      CHECK(power->rows.empty());
      CHECK(asked < until + 10);
    }
  }
}

TEST_CASE("a text with commas and quotes is one field of the file") {
  PageTable table("t", "", true);
  table.column("What", "what").column("Of", "of");
  table.row().text("narrow, \"wide\"").count(3);
  CHECK(table.csv() == "simulated,what,of\nyes,\"narrow, \"\"wide\"\"\",3\n");
}

TEST_CASE("planning writes tables that say they are simulated, and a check names what it asked") {
  const auto folder = OwnFolder::make();
  for (const char* kind : {"discrimination", "identification"}) {
    const auto rows = check_analysis(shipped_protocol(kind), 40);
    CHECK(rows.size() >= 5);
    for (const CheckRow& row : rows) {
      CAPTURE(row.what);
      CHECK(row.count > 0);
      CHECK(std::isfinite(row.found));
    }
    PlanningFiles files{folder->path() / kind, "workbench analyse p --check", "a < b"};
    PowerTable power{"thresholds, ratio", {{"paired t", 1.5, 12, 0.5, 0.4, 0.6, 0.5}}};
    REQUIRE(write_check(rows, files));
    REQUIRE(write_power(power, files));
    for (const auto& entry : std::filesystem::directory_iterator(files.folder)) {
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      CAPTURE(entry.path().string());
      const bool page = entry.path().extension() == ".html";
      CHECK(text.str().find(page ? "Nobody felt anything" : "simulated,") != std::string::npos);
      CHECK((text.str().find("a &lt; b") != std::string::npos) == page);
    }
  }
  bool asked = false;
  CHECK(check_analysis(shipped_protocol("identification"), 1000, [&] { return asked = true; }).size() < 3);
  CHECK(asked);
  int until = 1000;  // within a band of thresholds and its calibration
  CHECK(check_analysis(shipped_protocol("discrimination"), 500, [&] { return --until < 0; }).size() > 3);
  CHECK(until > -100);
}

}  // namespace
}  // namespace tangent::analysis
