// What stands beside a table of ticks: by the W3C's metadata vocabulary, read here by a JSON parser of its own.
#include "workbench/session/csv_metadata.h"

#include "core/io/ticks_file.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>

using namespace tangent;
using nlohmann::json;

TEST_CASE("every column of ticks.csv has its name, a description, a datatype and a unit") {
  const FileOrigin origin{"torus, 1152 triangles, 00", "quiet \"one\"", "1 unit = 0.001 m", "workbench solve torus"};
  const json read = json::parse(csv_metadata("ticks of today.csv", kTicksHeader, origin));
  CHECK(read["@context"] == "http://www.w3.org/ns/csvw");
  CHECK(read["url"] == "ticks%20of%20today.csv");
  CHECK(read["dc:provenance"][0] == "Mesh: torus, 1152 triangles, 00");
  CHECK(read["dc:provenance"][1] == "Preset: quiet \"one\"");
  std::string header;
  for (const json& column : read["tableSchema"]["columns"]) {
    CAPTURE(column.dump());
    header += (header.empty() ? "" : ",") + column["name"].get<std::string>();
    CHECK(column["titles"] == column["name"]);
    CHECK(column.contains("dc:description"));
    const std::string type = column["datatype"];
    CHECK((type == "integer" || type == "double" || type == "string"));
    CHECK(column.contains("schema:unitCode") == (type != "string"));
  }
  CHECK(header == kTicksHeader);
  const json& force = read["tableSchema"]["columns"][13];
  CHECK(force["name"] == "force_x_n");
  CHECK(force["schema:unitCode"] == "N");
}

TEST_CASE("it stands beside a regular file alone") {
  const tangent::testing::TempFolder folder;
  std::ofstream(folder.path() / "a.csv") << "tick\n";
  REQUIRE(write_csv_metadata(folder.path() / "a.csv", "tick,colour\n", {}));
  std::ifstream file(folder.path() / "a.csv-metadata.json");
  const json read = json::parse(file);
  CHECK(read["tableSchema"]["columns"][1] == json{{"name", "colour"}, {"titles", "colour"}});
  REQUIRE(write_csv_metadata("/dev/null", "tick\n", {}));
  CHECK_FALSE(std::filesystem::exists("/dev/null-metadata.json"));
  CHECK(folder.entry_count() == 2);
}
