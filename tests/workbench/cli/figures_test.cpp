// workbench figures, run as a process: checks the claims of the figures on their data.
#include "workbench/cli/figures.h"
#include "tests/support/approx.h"
#include "tests/support/process.h"
#include "tests/support/sanitized.h"
#include "workbench/session/figure_table.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

using namespace tangent;
using namespace tangent::testing;
using tangent::test::approx;

namespace {

/// Numbers below the header; an empty line parts.
std::vector<std::vector<double>> rows_of(const std::string& path) {
  std::vector<std::vector<double>> rows;
  std::istringstream in(read_text(path));
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    if (line.empty()) continue;
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace

TEST_CASE("figures writes every figure as SVG with its CSV, and the curvature table") {
  const TempFolder folder;
  const std::string out = folder.file("figures");
  const ProcessResult result = run_workbench({"figures", "--out", out});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  for (const char* name : {"fig04-contact-location", "fig06-iterations", "fig07-travel", "fig15-patches",
                           "fig16-labels", "fig17-tangents", "fig18-angles", "iterations-2d", "conditions-at-threshold",
                           "conditions-five-segments", "curvature-deviation", "inner-corner"}) {
    CAPTURE(name);
    CHECK(contains(read_text(out + "/" + name + ".svg"), "</svg>"));
    CHECK(rows_of(out + "/" + name + ".csv").size() > 2);
  }
  CHECK(contains(result.out, "tangent     bisectors             5   0.379"));

  // Fig. 4: on facets the contact stands still, then crosses the finger while it rolls over the edge.
  int still = 0;
  const auto contact = rows_of(out + "/fig04-contact-location.csv");
  for (std::size_t i = 1; i < contact.size(); ++i) still += std::abs(contact[i][2] - contact[i - 1][2]) < 1e-9;
  CHECK(still > static_cast<int>(contact.size()) * 9 / 10);
  CHECK(contact.front()[2] == approx(9.02).epsilon(1e-3));  // 20 mm times half of 0.902 rad
  CHECK(contact.back()[3] == approx(-9.02).epsilon(1e-3));

  // Five segments: full shading follows the circle, facets are off by half a facet's turn, a held display stands at 0.
  double p1 = 0.0, c1 = 0.0, held = 0.0;
  for (const auto& row : rows_of(out + "/conditions-five-segments.csv")) {
    c1 = std::max(c1, std::abs(row[3] - row[1]));
    held = std::max(held, std::abs(row[4]));
    p1 = std::max(p1, std::abs(row[11] - row[1]));
  }
  CHECK(p1 < 0.05);
  CHECK(c1 == approx(0.902 / 4 / 2 * 180 / 3.14159265).epsilon(0.2));
  CHECK(held == 0.0);
}

TEST_CASE("every column that a figure draws by name is in its tables") {
  // gnuplot draws nothing for a name that it doesn't find, and says nothing.
  int names = 0;
  for (const Figure& figure : {contact_location_figure(), iterations_figure(), travel_figure(), patches_figure(),
                               labels_figure(), tangents_figure(), angles_figure(), lines_figure(),
                               conditions_figure(true), conditions_figure(false), curvature_figure()}) {
    std::vector<std::string> columns;
    for (const FigureData& data : figure.data)
      columns.insert(columns.end(), data.table.columns.begin(), data.table.columns.end());
    for (std::size_t at = figure.script.find(" using "); at != std::string::npos;
         at = figure.script.find(" using ", at + 1)) {
      const std::string drawn = figure.script.substr(at, figure.script.find(" with ", at) - at);
      for (std::size_t open = drawn.find('\''); open != std::string::npos;) {
        const std::size_t close = drawn.find('\'', open + 1);
        const std::string name = drawn.substr(open + 1, close - open - 1);
        CAPTURE(figure.name);
        CAPTURE(name);
        // "_force_deg" stands behind the name of a condition.
        CHECK(std::any_of(columns.begin(), columns.end(), [&](const std::string& column) {
          return name.starts_with('_') ? column.ends_with(name) : column == name;
        }));
        ++names;
        open = drawn.find('\'', close + 1);
      }
      CHECK(drawn.find_first_of("123456789") == std::string::npos);
    }
  }
  CHECK(names > 30);
}

TEST_CASE("figures says where it can't write") {
  const TempFolder folder;
  folder.write("file", "");
  const ProcessResult result = run_workbench({"figures", "--out", folder.file("file") + "/x"});
  CHECK(result.exit_code == 1);
  CHECK(contains(result.err, "this folder can't be made"));
}

TEST_CASE("a folder's name is data: no newline, quote or control character in it makes gnuplot do anything" *
          doctest::skip(testing::kSanitized)) {
  const TempFolder folder;
  const std::string marker = folder.file("ran");
  const std::string odd[]{"a\nsystem 'touch " + marker + "'\n", "it's", "back`touch " + marker + "`tick",
                          "say \"x\"; $(id)", "tab\there\x01\x1b[31m"};
  for (const std::string& name : odd) {
    CAPTURE(name);
    // A slash in a name would be a folder: `marker` is given relative to the folder that gnuplot works in.
    std::string one = name;
    for (std::size_t at = one.find(marker); at != std::string::npos; at = one.find(marker))
      one.replace(at, marker.size(), "ran");
    const std::filesystem::path out = folder.path() / one;
    const ProcessResult result = run_workbench({"figures", "--out", out.string()});
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    CHECK(contains(read_text(out / "inner-corner.svg"), "</svg>"));
    CHECK_FALSE(std::filesystem::exists(marker));
    CHECK_FALSE(std::filesystem::exists(out / "ran"));
    CHECK_FALSE(std::filesystem::exists("ran"));
  }
}
