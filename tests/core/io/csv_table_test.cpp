#include "core/io/csv_table.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <array>

using namespace tangent;
using tangent::testing::contains;

namespace {

constexpr std::array<std::string_view, 2> kNeeded{"x_m", "y_m"};
constexpr std::array<std::string_view, 2> kOptional{"qw", "qx"};
using Row = std::array<double, 4>;

std::vector<Row> rows_of(std::string_view text) {
  auto table = CsvTable::open(text, "t.csv", kNeeded, kOptional);
  REQUIRE(table);
  std::vector<Row> rows;
  while (table->next_line()) {
    Row row{};
    REQUIRE(table->read_numbers(row));
    rows.push_back(row);
  }
  return rows;
}

std::string header_refusal(std::string_view text) {
  const auto table = CsvTable::open(text, "t.csv", kNeeded, kOptional);
  REQUIRE_FALSE(table);
  return table.error().message();
}

std::string line_refusal(std::string_view text) {
  auto table = CsvTable::open(text, "t.csv", kNeeded, kOptional);
  REQUIRE(table);
  Row row{};
  while (table->next_line()) {
    if (const Status status = table->read_numbers(row); !status) return status.error().message();
  }
  return {};
}

}  // namespace

TEST_CASE("columns are found by name in any order, and what nobody asked for is passed over") {
  const std::vector<Row> expected{{1.0, 2.0, 0.0, 0.0}, {3.0, 4.0, 0.0, 0.0}};
  CHECK(rows_of("x_m,y_m\n1,2\n3,4\n") == expected);
  CHECK(rows_of("y_m,x_m\n2,1\n4,3\n") == expected);
  CHECK(rows_of("x_m,y_m,note\n1,2,text\n3,4,\n") == expected);
  CHECK(rows_of("note,y_m,,x_m\nnan,2,7,1\n,4,,3") == expected);
  CHECK(rows_of("qx,y_m,qw,x_m\r\n4,2,3,1\r\n\r\n") == std::vector<Row>{{1.0, 2.0, 3.0, 4.0}});
  CHECK(rows_of("\xEF\xBB\xBFx_m,y_m\n").empty());
}

TEST_CASE("a column that is missing or there twice is named") {
  CHECK(
      header_refusal("x_m,z_m\n1,2\n") ==
      "t.csv:1: the header is \"x_m,z_m\": y_m is missing; write the columns x_m,y_m, and all or none of qw,qx, in any "
      "order");
  CHECK(contains(header_refusal(""), "x_m is missing"));
  CHECK(contains(header_refusal("x_m,y_m,qx\n"), "qw is missing"));
  CHECK(contains(header_refusal("x_m,y_m,x_m\n"), "x_m is there twice"));
  CHECK(contains(header_refusal("x_m,y_m,qw,qx,qw\n"), "qw is there twice"));
  CHECK(contains(header_refusal("X_M,y_m\n"), "x_m is missing"));
}

TEST_CASE("a field that is no number, and a line of another length than the header, are named with their line") {
  CHECK(line_refusal("y_m,x_m\n1,2\nmany,2\n") == "t.csv:3: y_m is \"many\"; write a finite decimal number");
  CHECK(line_refusal("x_m,note,y_m\n1,2\n") == "t.csv:2: only 2 columns; write 3 fields separated by commas");
  CHECK(contains(line_refusal("x_m,y_m\n1,2,3\n"), "t.csv:2: more columns than the header names"));
  CHECK(contains(line_refusal("x_m,y_m\n1,2\n\n3,4\n"), "t.csv:3: x_m is \"\""));
}
