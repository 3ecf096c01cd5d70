// Figures of a page: SVG that can stand beside others.
#include "tests/support/approx.h"
#include "tests/workbench/report/report_fixture.h"
#include "workbench/report/report_figures.h"

#include <cmath>
#include <set>

using namespace tangent;
using namespace tangent::test;

namespace {

std::set<std::string> ids_of(const std::string& svg) {
  std::set<std::string> ids;
  for (const std::string quote : {"'", "\""})
    for (std::size_t at = 0; (at = svg.find(" id=" + quote, at)) != svg.npos;) {
      at += 5;
      ids.insert(svg.substr(at, svg.find(quote, at) - at));
    }
  return ids;
}

}  // namespace

TEST_CASE("two figures in one page share no identifier, and what they refer to is their own") {
  Figure figure{.name = "one", .title = ""};
  figure.data.push_back({"", {{"x", "y"}, {{1.0, 2.0}, {2.0, 3.0}, {3.0, 1.0}}}});
  figure.script = "plot DIR.'/one.csv' using 1:2 with linespoints pt 7\n";
  const auto one = figure_svg(figure);
  figure.name = "two";
  figure.script = "plot DIR.'/two.csv' using 1:2 with linespoints pt 7\n";
  const auto two = figure_svg(figure);
  REQUIRE(one);
  REQUIRE(two);
  CHECK(one->starts_with("<svg"));
  CHECK_FALSE(says(*one, "<title>"));
  CHECK(says(*one, "</svg>"));
  CHECK(ids_of(*one).size() > 3);
  for (const std::string& id : ids_of(*one)) {
    CHECK(id.starts_with("one-"));
    CHECK_FALSE(ids_of(*two).contains(id));
  }
  for (std::size_t at = 0; (at = one->find("href='#", at)) != one->npos; ++at) {
    const std::size_t from = at + 7;
    CHECK(ids_of(*one).contains(one->substr(from, one->find('\'', from) - from)));
  }
  figure.script = "no such command\n";
  CHECK_FALSE(figure_svg(figure));
}

TEST_CASE("the curves over time hold the least and largest of every part, and a gap where nothing was recorded") {
  RecordingReport report;
  report.info.last_s = 3.0;
  RecordingSummary& sum = report.summary;
  sum.ticks = 2400;
  sum.parts.resize(4);
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == 2) continue;
    sum.parts[i].include(static_cast<double>(i), {1.0, 0.5, -1e-3, 0.0, 0.0, 1e-6, 1.0});
    sum.parts[i].include(static_cast<double>(i) + 0.5, {3.0, 0.5, 2e-3, 0.0, 0.0, 0.0, 7.0});
  }
  const Figure figure = time_figure(report, "f");
  const FigureTable& table = figure.data.front().table;
  REQUIRE(table.columns.size() == kDrawn + 1);
  REQUIRE(table.rows.size() == 7);  // two each, and a gap
  CHECK(table.rows[4].empty());
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
  };
  CHECK(table.rows[0][column("force_n")] == 1.0);
  CHECK(table.rows[1][column("force_n")] == 3.0);
  CHECK(table.rows[1][column("penetration_mm")] == approx(2.0));
  CHECK(table.rows[0][column("error_um")] == 1e-9);  // 0 on a logarithmic axis
  CHECK(table.rows[1][column("planes")] == 7.0);
  CHECK(letter_of(0) == "A");
  REQUIRE(figure_svg(figure));
}

TEST_CASE("quantiles of times are within 2 %, and of equal times exact") {
  TimeSpread times;
  for (int i = 1; i <= 1000; ++i) times.add(1e3 * i);
  CHECK(times.quantile_ns(0.5) == approx(500e3).epsilon(0.02));
  CHECK(times.quantile_ns(0.99) == approx(990e3).epsilon(0.02));
  CHECK(times.quantile_ns(1.0) == 1e6);
  TimeSpread same;
  for (int i = 0; i < 9; ++i) same.add(1e6);
  CHECK(same.quantile_ns(0.5) == 1e6);
}

TEST_CASE("the report of more than a second shows how rough force and display were, by frequency") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(1024);
  recorded.finish();
  auto recording = Recording::open(path);
  REQUIRE(recording);
  const auto summary = summarise(*recording, [] { return false; });
  REQUIRE(summary);
  REQUIRE(summary->spectrum.windows == 1);
  SpectrumCounter counter(summary->spectrum.rate_hz);
  for (const RecordedTick& tick : all_ticks(path)) {
    const TickOutput& out = tick.record.tick.output;
    counter.add(out.force_n, out.cld_m, tick.record.tick.tick > 0);
  }
  CHECK(summary->spectrum.force_n2_per_hz == counter.done().force_n2_per_hz);
  CHECK(summary->spectrum.display_mm2_per_hz == counter.done().display_mm2_per_hz);
  const std::string html = page_of(quick_report({path}, folder.path() / "out"));
  CHECK(says(html, "Roughness of force and display by frequency"));
  CHECK(says(html, "Hann windows of 1024 ticks"));
  CHECK(parsed(folder.path() / "out" / "report.html")["faults"].empty());
}
