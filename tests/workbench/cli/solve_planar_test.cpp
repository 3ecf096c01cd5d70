// workbench solve on 2D scenes, run as a process.
#include "tests/support/approx.h"
#include "tests/support/process.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

using namespace tangent::testing;
using tangent::test::approx;

namespace {

struct Scene {
  TempFolder folder;
  std::string arc = folder.write("arc.csv", "x_m,y_m\n-0.08,0\n-0.04,0.03\n0,0.04\n0.04,0.03\n0.08,0\n");
  std::string poses = folder.file("poses.csv"), ticks = folder.file("ticks.csv");
  Scene() {
    std::ostringstream text;
    text << "t_s,x_m,y_m,z_m\n";
    for (int i = 0; i <= 100; ++i) text << i * 1e-3 << "," << (i - 50) * 1e-4 << "," << 0.056 << ",0.5\n";
    folder.write("poses.csv", text.str());
  }
  ProcessResult solve(const std::vector<std::string>& more, const std::string& mesh = {}) const {
    std::vector<std::string> words{"solve", mesh.empty() ? arc : mesh, "--poses", poses, "--out", ticks};
    words.insert(words.end(), more.begin(), more.end());
    return run_workbench(words);
  }
};

std::vector<std::string> fields_of(const std::string& text, int row) {
  std::istringstream in(text);
  std::string line;
  for (int i = 0; i <= row; ++i) std::getline(in, line);
  std::istringstream cells(line);
  std::vector<std::string> out;
  for (std::string cell; std::getline(cells, cell, ',');) out.push_back(cell);
  return out;
}

}  // namespace

TEST_CASE("poses that touch nothing of a polygon are remarked on") {
  const Scene scene;
  scene.folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0,0.08,0\n0.001,0,0.08,0\n");
  const ProcessResult out = scene.solve({});
  CHECK(out.exit_code == 0);
  CHECK(contains(out.err, "the finger touched nothing in 2 of 2 ticks; the nearest it came was 22.5 mm"));
}

TEST_CASE("solve takes a CSV polygon as it takes a mesh, with every method, and records its iterations") {
  const Scene scene;
  for (const char* method : {"paper", "newton", "robust", "facet", "force-shading", "two-pass"}) {
    const ProcessResult out = scene.solve(
        {"--method", method, "--iterations", scene.folder.file("it.csv"), "--summary", scene.folder.file("s.json")});
    CAPTURE(out.err);
    REQUIRE(out.exit_code == 0);
    CHECK(contains(out.out, "101 ticks on arc.csv (open polygon, 5 vertices)"));
    const auto summary = nlohmann::json::parse(read_text(scene.folder.file("s.json")));
    CHECK(summary.at("scene").at("dimensions") == 2);
    CHECK(summary.at("mesh").is_null());
    CHECK(summary.at("scene").at("memory_bytes") > 0);
    CHECK(summary.at("statuses").at("free") == 0);
    CHECK(summary.at("statuses").at("unconverged") == 0);
    const auto row = fields_of(read_text(scene.ticks), 51);  // above the middle vertex
    CHECK(std::stod(row.at(6)) == approx(0.0).scale(1.0));
    CHECK(std::stod(row.at(8)) == 0.0);
    CHECK(std::stod(row.at(10)) == approx(1.0));
  }
}

TEST_CASE("solve takes an OBJ polyline in its unit") {
  const Scene scene;
  scene.folder.write("arc.obj", "v -80 0 0\nv -40 30 0\nv 0 40 0\nv 40 30 0\nv 80 0 0\nl 1 2 3 4 5\n");
  REQUIRE(scene.solve({}).exit_code == 0);
  const auto csv = fields_of(read_text(scene.ticks), 30);
  REQUIRE(scene.solve({}, scene.folder.file("arc.obj")).exit_code == 0);
  const auto obj = fields_of(read_text(scene.ticks), 30);
  CHECK(std::stod(csv.at(12)) == approx(std::stod(obj.at(12))).epsilon(1e-9));
}

TEST_CASE("solve names conditions and the local centre - a held display parks at its centre") {
  const Scene scene;
  REQUIRE(scene.solve({"--condition", "C1"}).exit_code == 0);
  for (const int row : {10, 60, 90}) CHECK(std::stod(fields_of(read_text(scene.ticks), row).at(16)) == 0.0);
  REQUIRE(scene.solve({"--condition", "C4", "--local-centre", "midpoint"}).exit_code == 0);
  CHECK(std::stod(fields_of(read_text(scene.ticks), 90).at(16)) != 0.0);
}

TEST_CASE("solve refuses polygons that are none, with a message and exit code 1") {
  const Scene scene;
  const auto refused = [&](const std::string& rows, const std::string& part) {
    const ProcessResult out = scene.solve({}, scene.folder.write("bad.csv", rows));
    CAPTURE(out.err);
    CHECK(out.exit_code == 1);
    CHECK(contains(out.err, part));
  };
  refused("x_m,y_m\n0,0\n1,1\n1,0\n0,1\n", "crosses or touches itself");
  refused("x_m,y_m\n0,0\n1,1\n", "only 2 different vertices");
  refused("x_m,y_m\n0,0\n1,1\n1,1\n1,1\n2,0\n", "three times or more");
  refused("x_m,y_m\n0,0\nnan,1\n1,0\n", "x_m is \"nan\"");
  refused("x_m,y_m\n0\n1\n", "only one column");
  refused("x_m,y_m\n0,0\n1,0\n1,1\n0,1\n0,0.00001\n", "not closed, but its ends all but meet");
}
